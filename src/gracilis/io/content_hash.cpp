#include <gracilis/io/content_hash.hpp>

#include <gracilis/io/input_file.hpp>

#include <fmt/format.h>

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace gracilis {

std::string content_hash_of(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("OpenSSL offers no SHA-256");
  }
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string content_hash(const std::filesystem::path& path) { return content_hash_of(read_text(path)); }

}  // namespace gracilis
