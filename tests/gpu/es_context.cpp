#include "gpu/es_context.hpp"

#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace zonal::gpu {

namespace {

constexpr const char* kVertexShader = R"(#version 300 es
void main() {  // one triangle over the whole picture
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

[[noreturn]] void fail_without_driver(const std::string& found) {
    throw std::runtime_error(fmt::format(
        "no OpenGL ES 3.0 without a window: {} (EGL error {:#x}), wanted Mesa's llvmpipe by "
        "EGL_MESA_platform_surfaceless; install the packages libegl1, libgles2 and libgl1-mesa-dri",
        found, eglGetError()));
}

bool has_extension(const char* all, const std::string& name) {
    return all != nullptr && fmt::format(" {} ", all).find(" " + name + " ") != std::string::npos;
}

/// The name of an object of OpenGL, which is deleted at the end of its scope.
class Object {
  public:
    using Delete = void (*)(GLuint);
    Object(GLuint name, Delete destroy) : name_(name), destroy_(destroy) {}
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() { destroy_(name_); }
    GLuint name() const { return name_; }

  private:
    GLuint name_;
    Delete destroy_;
};

void attach(const Object& program, GLenum kind, const std::string& text) {
    const Object shader(glCreateShader(kind), [](GLuint name) { glDeleteShader(name); });
    const char* begin = text.c_str();
    glShaderSource(shader.name(), 1, &begin, nullptr);
    glCompileShader(shader.name());
    GLint is_compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &is_compiled);
    if (is_compiled == GL_FALSE) {
        std::array<char, 2000> log{};
        glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw std::runtime_error(fmt::format("GLSL ES cannot be compiled: {}", log.data()));
    }
    glAttachShader(program.name(), shader.name());
}

void link(const Object& program, const std::string& fragment_shader) {
    attach(program, GL_VERTEX_SHADER, kVertexShader);
    attach(program, GL_FRAGMENT_SHADER, fragment_shader);
    glLinkProgram(program.name());
    GLint is_linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &is_linked);
    if (is_linked == GL_FALSE) {
        std::array<char, 2000> log{};
        glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw std::runtime_error(fmt::format("GLSL ES cannot be linked: {}", log.data()));
    }
}

/// A texture of floats that is read texel by texel, bound to the active unit.
class FloatTexture : public Object {
  public:
    FloatTexture(GLenum format, int width, int height)
        : Object(generated(), [](GLuint name) { glDeleteTextures(1, &name); }) {
        glBindTexture(GL_TEXTURE_2D, name());
        glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }

  private:
    static GLuint generated() {
        GLuint name = 0;
        glGenTextures(1, &name);
        return name;
    }
};

}  // namespace

EsContext::EsContext() {
    // The answer must not depend on a GPU of this machine; whoever runs the program may choose another
    // driver.
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", 0);
    ::setenv("GALLIUM_DRIVER", "llvmpipe", 0);
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    // llvmpipe compiles thousands of straight lines far faster without LLVM's optimizer.
    ::setenv("GALLIVM_PERF", "nopt", 0);
    if (!has_extension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
        fail_without_driver("EGL has no such platform");
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE)
        fail_without_driver("EGL gives no display");
    if (eglBindAPI(EGL_OPENGL_ES_API) == EGL_FALSE) fail_without_driver("EGL knows no OpenGL ES");
    constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes);
    if (context_ == EGL_NO_CONTEXT) fail_without_driver("EGL makes no context");
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
        fail_without_driver("the context needs a surface");
    const auto* extensions = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
    if (!has_extension(extensions, "GL_EXT_color_buffer_float"))
        fail_without_driver(name() + " has no EXT_color_buffer_float");
}

EsContext::~EsContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

std::string EsContext::name() const {
    return fmt::format("{}, {}", reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                       reinterpret_cast<const char*>(glGetString(GL_VERSION)));
}

std::vector<float> EsContext::draw(const std::string& fragment_shader, std::span<const Texture> textures,
                                   int width, int height) const {
    const Object program(glCreateProgram(), [](GLuint name) { glDeleteProgram(name); });
    link(program, fragment_shader);
    glUseProgram(program.name());

    std::vector<std::unique_ptr<FloatTexture>> bound;
    for (const Texture& texture : textures) {
        const auto unit = static_cast<GLint>(bound.size());
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        bound.push_back(std::make_unique<FloatTexture>(GL_R32F, texture.width, texture.height));
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texture.width, texture.height, GL_RED, GL_FLOAT,
                        texture.values.data());
        glUniform1i(glGetUniformLocation(program.name(), texture.name.c_str()), unit);
    }

    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(bound.size()));
    const FloatTexture picture(GL_RGBA32F, width, height);
    GLuint framebuffer_name = 0;
    glGenFramebuffers(1, &framebuffer_name);
    const Object framebuffer(framebuffer_name, [](GLuint name) { glDeleteFramebuffers(1, &name); });
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.name(), 0);
    glViewport(0, 0, width, height);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    std::vector<float> values(std::size_t{4} * static_cast<std::size_t>(width) *
                              static_cast<std::size_t>(height));
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, values.data());
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw std::runtime_error(fmt::format(
            "{}: OpenGL error {:#x} of a draw of {} x {} pixels, wanted none", name(), error, width, height));
    return values;
}

}  // namespace zonal::gpu
