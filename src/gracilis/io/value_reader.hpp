#pragma once

#include <gracilis/core/types.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace gracilis {

/// How a number is stored in a binary file.
enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// How the numbers of a file are written.
enum class Encoding { text, little_endian, big_endian };

/// Walks through a file's bytes: words and lines of text, and numbers in any encoding. Every complaint is an InputError
/// that names the file and the line (or, once a binary number was read, the byte). Never reads beyond the end.
class ValueReader {
 public:
  /// `bytes` must outlive the reader.
  ValueReader(std::filesystem::path path, std::string_view bytes) : path_(std::move(path)), bytes_(bytes) {}

  Encoding encoding = Encoding::text;  ///< of the numbers that follow

  /// The next word between white space, on this line or a later one; empty at the end of the file.
  std::string_view word();
  /// The rest of the current line without its line break (`\n` or `\r\n`).
  std::string_view line();
  /// The next number; integers are exact up to 2^53.
  double number(ScalarType type);
  /// A number that counts things to come, each at least `bytes_each` long here: more than the file has left is an
  /// error.
  std::size_t count(std::string_view text, std::size_t bytes_each = 1);

  bool at_end() const { return position_ >= bytes_.size(); }  ///< no byte is left
  /// Steps back before the last word read.
  void unread_word() { position_ = word_begin_; }

  /// Throws InputError about the place that was read last.
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = "export the file again") const;

 private:
  std::size_t line_number() const;

  std::filesystem::path path_;
  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t word_begin_ = 0;
  bool read_binary_ = false;
};

/// Bytes of one number in a binary file.
std::size_t size_of(ScalarType type);

/// The whole text as a number ("1", "+1.5e3", "nan"); false when it is anything else.
bool parse_number(std::string_view text, double& value);

/// The whole text as an integer.
bool parse_integer(std::string_view text, long long& value);

/// The whole text as a number that counts or numbers things: from 0 to the largest index.
bool parse_index(std::string_view text, Index& value);

}  // namespace gracilis
