// Loads the plug-in and has it turn the x lobe by a quarter turn about z, then a vector of a wrong length.
#include <dlfcn.h>

#include <cmath>
#include <cstdio>

int main(int, char** arguments) {
    void* plugin = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (plugin == nullptr) {
        std::puts(dlerror());
        return 1;
    }
    const auto turn = reinterpret_cast<int (*)(const float*, float*, int)>(dlsym(plugin, "turn"));
    const float quarter_turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    float f[9] = {0, 0, 0, 1};
    if (turn(quarter_turn, f, 9) != 0 || std::abs(f[1] - 1) > 1e-6F || std::abs(f[3]) > 1e-6F) return 2;
    if (turn(quarter_turn, f, 8) != 1) return 3;
    return dlclose(plugin);
}
