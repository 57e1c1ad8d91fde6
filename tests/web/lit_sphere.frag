// Shades a ball, matte under a mirroring glaze, by an SH light that every fragment turns for itself.
//
// Compiled behind `#version 300 es`, `precision highp float;`, the text of generated/glsl/orderNN/rotate.glsl and
//     #define ORDER           3 or 4
//     #define ROTATE          zonal_orderN_rotate
//     #define SHOWS_PROBE     1: fragment i writes coefficient i of the turned light; 0: the ball
//
// Camera: orthographic, looking along -x, y to the right, z up; the unit ball fills the square. With the picture's
// size a power of two, y, z and y^2 + z^2 are exact in float, so coverage is the same everywhere.
// Colour: sum_i f'_i (matte a_l y_i(n) + mirror y_i(r)), f' the turned light, n the normal, r the mirrored view.
//   a_l = 1, 2/3, 1/4, 0: the clamped cosine over pi (Ramamoorthi and Hanrahan 2001, eq. 8).
// tests/web/shading.cpp bounds the rounding of this very text: change both.

uniform float rotation[9];           // row-major, f'(w) = f(R^T w)
uniform vec3 light[ORDER * ORDER];   // RGB, index l(l+1)+m
uniform float matte;
uniform float mirror;
uniform float pixel;                 // width of one, 2 / size: a power of two, so that products with it are exact
out vec4 colour;

// Real, orthonormal, no Condon-Shortley sign, z polar.
void evaluate_basis(vec3 w, out float basis[ORDER * ORDER]) {
    float x = w.x;
    float y = w.y;
    float z = w.z;
    basis[0] = 0.28209479177;
    basis[1] = 0.48860251190 * y;
    basis[2] = 0.48860251190 * z;
    basis[3] = 0.48860251190 * x;
    basis[4] = 1.09254843059 * (x * y);
    basis[5] = 1.09254843059 * (y * z);
    basis[6] = 0.31539156525 * (3.0 * (z * z) - 1.0);
    basis[7] = 1.09254843059 * (x * z);
    basis[8] = 0.54627421529 * (x * x - y * y);
#if ORDER > 3
    basis[9] = 0.59004358992 * (y * (3.0 * (x * x) - y * y));
    basis[10] = 2.89061144264 * (x * y * z);
    basis[11] = 0.45704579946 * (y * (5.0 * (z * z) - 1.0));
    basis[12] = 0.37317633259 * (z * (5.0 * (z * z) - 3.0));
    basis[13] = 0.45704579946 * (x * (5.0 * (z * z) - 1.0));
    basis[14] = 1.44530572132 * (z * (x * x - y * y));
    basis[15] = 0.59004358992 * (x * (x * x - 3.0 * (y * y)));
#endif
}

float cosine_factor(int i) { return i == 0 ? 1.0 : i < 4 ? 0.66666666667 : i < 9 ? 0.25 : 0.0; }

void main() {
    vec3 turned[ORDER * ORDER];
    ROTATE(rotation, light, turned);
#if SHOWS_PROBE
    colour = vec4(turned[int(gl_FragCoord.x)], 1.0);
#else
    vec2 p = pixel * gl_FragCoord.xy - 1.0;
    float square = dot(p, p);
    if (square >= 1.0) {
        colour = vec4(0.0);
        return;
    }
    float towards_eye = sqrt(1.0 - square);
    float normal_basis[ORDER * ORDER];
    float mirrored_basis[ORDER * ORDER];
    evaluate_basis(vec3(towards_eye, p), normal_basis);
    evaluate_basis(vec3(1.0 - 2.0 * square, 2.0 * (towards_eye * p)), mirrored_basis);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < ORDER * ORDER; ++i) {
        float weight = matte * cosine_factor(i) * normal_basis[i] + mirror * mirrored_basis[i];
        sum += weight * turned[i];
    }
    colour = vec4(sum, 1.0);
#endif
}
