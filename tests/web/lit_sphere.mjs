// The page's side of the lit ball: compiles the committed GLSL in WebGL2, renders into float textures, reads them
// back and shows them. What is rendered stands in the scene (tests/web/scene.hpp), how in lit_sphere.frag.

const VERTEX = `#version 300 es
void main() {  // one triangle over the whole picture
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

// Linear radiance to sRGB, as zonal/png.hpp.
const SHOW = `#version 300 es
precision highp float;
uniform sampler2D picture;
uniform float exposure;
out vec4 colour;
void main() {
    vec4 linear = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
    vec3 v = clamp(exposure * linear.rgb, 0.0, 1.0);
    vec3 srgb = mix(12.92 * v, 1.055 * pow(max(v, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
    colour = vec4(srgb * linear.a, linear.a);
}`;

function context(size) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const gl = canvas.getContext("webgl2", { preserveDrawingBuffer: true });
  if (!gl) throw new Error("the browser gives no WebGL2 context: check its flags and its list of blocked GPUs");
  return gl;
}

async function text(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: found status ${response.status}, wanted the file`);
  return response.text();
}

function compile(gl, kind, source, name) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
    const messages = gl.getShaderInfoLog(shader).split("\n").slice(0, 3);  // the others follow from the first
    throw new Error(`${name}: ${messages.join("; ")}`);
  }
  return shader;
}

function link(gl, fragment, name) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, VERTEX, "vertex shader"));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, fragment, name));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`${name}: ${gl.getProgramInfoLog(program)}`);
  return program;
}

/// A float picture to render into and to read: { texture, framebuffer }.
function floatTarget(gl, width, height) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
  if (status !== gl.FRAMEBUFFER_COMPLETE) throw new Error(`float framebuffer: status ${status}, wanted a complete one`);
  return { texture, framebuffer, width, height };
}

function draw(gl, target) {
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
  gl.viewport(0, 0, target.width, target.height);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

/// The target's values, rows from the bottom, four floats a pixel.
function read(gl, target) {
  const values = new Float32Array(4 * target.width * target.height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
  gl.readPixels(0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, values);
  return values;
}

function setScene(gl, program, scene, order, rotation) {
  gl.useProgram(program);
  const at = (name) => gl.getUniformLocation(program, name);
  gl.uniform1fv(at("rotation"), rotation);
  gl.uniform3fv(at("light"), scene.light.slice(0, order * order).flat());
  gl.uniform1f(at("matte"), scene.matte);
  gl.uniform1f(at("mirror"), scene.mirror);
  gl.uniform1f(at("pixel"), 2 / scene.size);
}

function show(gl, program, target, exposure, parent) {
  gl.useProgram(program);
  gl.bindTexture(gl.TEXTURE_2D, target.texture);
  gl.uniform1f(gl.getUniformLocation(program, "exposure"), exposure);
  draw(gl, { framebuffer: null, width: target.width, height: target.height });
  const copy = document.createElement("canvas");
  copy.width = target.width;
  copy.height = target.height;
  copy.getContext("2d").drawImage(gl.canvas, 0, 0);
  parent.append(copy);
}

function base64(bytes) {
  let characters = "";
  for (let i = 0; i < bytes.length; i += 8192) characters += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(characters);
}

/// Renders every picture of the scene, orders outermost, then rotations, and appends them to `parent`.
/// Returns { renderer, values }: base64 of floats, four a value; of each picture first the N^2 coefficients of the
/// turned light, then size^2 pixels, rows from the bottom.
export async function litSphere(sceneUrl, parent) {
  if (!sceneUrl) throw new Error("lit_sphere.html: found no scene, wanted lit_sphere.html?scene=URL of scene.json");
  const scene = JSON.parse(await text(sceneUrl));
  const shading = await text("lit_sphere.frag");
  const kernels = {};
  for (const order of scene.orders) kernels[order] = await text(`../../generated/glsl/order0${order}/rotate.glsl`);

  const gl = context(scene.size);
  if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("EXT_color_buffer_float is missing");
  parent.style.gridTemplateColumns = `repeat(${scene.rotations.length}, ${scene.size}px)`;

  const shows = link(gl, SHOW, "display shader");
  const parts = [];
  for (const order of scene.orders) {
    const source = (showsProbe) => `#version 300 es
precision highp float;
#define ORDER ${order}
#define ROTATE zonal_order${order}_rotate
#define SHOWS_PROBE ${showsProbe}
#line 1 1
${kernels[order]}
#line 1 2
${shading}`;
    const files = `(1: order0${order}/rotate.glsl, 2: lit_sphere.frag)`;
    const probe = link(gl, source(1), `order ${order}, turned light ${files}`);
    const ball = link(gl, source(0), `order ${order}, ball ${files}`);
    const probeTarget = floatTarget(gl, order * order, 1);
    const ballTarget = floatTarget(gl, scene.size, scene.size);
    for (const rotation of scene.rotations) {
      for (const [program, target] of [[probe, probeTarget], [ball, ballTarget]]) {
        setScene(gl, program, scene, order, rotation);
        draw(gl, target);
        parts.push(read(gl, target));
      }
      show(gl, shows, ballTarget, scene.exposure, parent);
    }
  }
  const error = gl.getError();
  if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}, wanted none`);

  const values = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((offset, part) => (values.set(part, offset), offset + part.length), 0);
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  const uniforms = gl.getParameter(gl.MAX_FRAGMENT_UNIFORM_VECTORS);
  return { renderer, uniforms, values: base64(new Uint8Array(values.buffer)) };
}

/// Compiles each file of functions as GLSL ES 3.00, every function of it; the first that does not is an error.
export async function compileAll(urls) {
  const gl = context(1);
  for (const url of urls) {
    const source = `#version 300 es
precision highp float;
#line 1 1
${await text(url)}
out vec4 colour;
void main() { colour = vec4(1.0); }`;
    gl.deleteShader(compile(gl, gl.FRAGMENT_SHADER, source, url));
  }
}
