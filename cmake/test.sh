#!/usr/bin/env bash
# Installs what is missing, builds with g++ (release; batches for this processor) and runs every test but the heaviest
# shaders (.ci/run has them): ctest --test-dir build/release -L heavy
#   bash cmake/test.sh [options for ctest]
# Where CI is set, warnings are errors. What takes the time: bash cmake/cost.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bash cmake/install_packages.sh
cmake --preset release -DZONAL_BATCH_TARGETS=host ${CI:+-DZONAL_WARNINGS_AS_ERRORS=ON}
cmake --build --preset release
ctest --test-dir build/release --output-on-failure --parallel "$(nproc)" --label-exclude heavy "$@"
