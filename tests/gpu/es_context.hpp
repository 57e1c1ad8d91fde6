#pragma once

#include <EGL/egl.h>
#include <GLES3/gl3.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace zonal::gpu {

/// OpenGL ES 3.0 without a window or a GPU: Mesa's llvmpipe by surfaceless EGL, current in this thread while
/// it lives. Everything here throws std::runtime_error; where there is no such driver it names what to
/// install.
class EsContext {
  public:
    EsContext();
    EsContext(const EsContext&) = delete;
    EsContext& operator=(const EsContext&) = delete;
    ~EsContext();

    /// The driver's name and version.
    std::string name() const;

    /// Floats that a shader reads by the sampler of this name: .r of a texel, rows tightly packed.
    struct Texture {
        std::string name;
        int width = 0, height = 0;
        std::span<const float> values;
    };
    /// A picture that a fragment shader draws, four floats a pixel, rows tightly packed. The shader's text is
    /// whole, with its #version.
    std::vector<float> draw(const std::string& fragment_shader, std::span<const Texture> textures, int width,
                            int height) const;

  private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace zonal::gpu
