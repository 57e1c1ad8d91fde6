// Reads a map that is not there.
#include <cstdio>

#include "zonal/environment_map.hpp"
#include "zonal/error.hpp"

int main() {
    try {
        zonal::read_environment_map("nowhere.exr");
    } catch (const zonal::Error& error) {
        std::puts(error.what());
    }
}
