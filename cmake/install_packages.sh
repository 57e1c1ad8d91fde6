#!/usr/bin/env bash
# Installs the Debian packages that building, testing and running need, where they are missing.
set -euo pipefail
packages=(
  g++ cmake ninja-build pkg-config git
  libeigen3-dev libboost-dev libnlopt-dev libnlopt-cxx-dev libtbb-dev libfmt-dev libcli11-dev nlohmann-json3-dev
  libssl-dev libopenexr-dev libstb-dev libgtest-dev libgmock-dev libbenchmark-dev libhwy-dev
  spirv-tools spirv-headers spirv-cross glslang-dev glslang-tools
  libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers libegl-dev libgles-dev libgl1-mesa-dri
)
packages+=("$@")
missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
echo "installing: ${missing[*]}"
sudo=
if [ "$(id -u)" -ne 0 ]; then sudo=sudo; fi
export DEBIAN_FRONTEND=noninteractive
$sudo apt-get -q -o DPkg::Lock::Timeout=500 update
$sudo apt-get -q -o DPkg::Lock::Timeout=500 install -y --no-install-recommends "${missing[@]}"
