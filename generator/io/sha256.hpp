#pragma once

#include <string>

namespace zonal {

/// 64 hexadecimal digits.
std::string sha256_hex(const std::string& bytes);

/// The first 16 of them, by which tables and bounds are named.
inline std::string short_sha256(const std::string& bytes) { return sha256_hex(bytes).substr(0, 16); }

}  // namespace zonal
