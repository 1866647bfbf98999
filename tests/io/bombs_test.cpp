#include <gracilis/io/mesh/mesh_reader.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <sys/resource.h>

#include <cstdint>
#include <cstring>

using namespace gracilis;
using testing::HasSubstr;

namespace {

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), sizeof(Number) * numbers.size()};
}

/// An array as .vtp has it: so many zeros, in blocks of a megabyte that zlib makes a thousandth of.
std::string zeros(std::size_t bytes) {
  constexpr std::size_t block = 1 << 20;
  vtkNew<vtkZLibDataCompressor> compressor;
  const std::string plain(block, '\0');
  std::string packed(2 * block, '\0');
  packed.resize(compressor->Compress(reinterpret_cast<const unsigned char*>(plain.data()), plain.size(),
                                     reinterpret_cast<unsigned char*>(packed.data()), packed.size()));
  const std::size_t count = bytes / block;
  std::vector<std::uint32_t> header = {static_cast<std::uint32_t>(count), block, 0};
  header.insert(header.end(), count, static_cast<std::uint32_t>(packed.size()));
  std::string stored = bytes_of(header);
  for (std::size_t i = 0; i < count; ++i) stored += packed;
  return stored;
}

/// A surface whose points are `points`, and which announces so many.
std::string vtp_of(const std::string& points, std::size_t announced, const std::string& type = "Float32") {
  return fmt::format(
             "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
             "compressor=\"vtkZLibDataCompressor\">\n<PolyData><Piece NumberOfPoints=\"{}\" NumberOfPolys=\"1\">\n"
             "<Points><DataArray type=\"{}\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points>\n"
             "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\n"
             "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>\n"
             "</Piece></PolyData>\n<AppendedData encoding=\"raw\">_",
             announced, type) +
         points + "</AppendedData></VTKFile>";
}

/// Largest memory of this process so far, bytes.
std::size_t peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

TEST(Bombs, an_array_that_unpacks_to_gigabytes_is_refused_before_it_does) {
  const TestFolder folder;
  const std::size_t bytes = std::size_t{1536} << 20;
  const auto file = folder.write("bomb.vtp", vtp_of(zeros(bytes), bytes / 12));
  ASSERT_LT(std::filesystem::file_size(file), 4u << 20);
  const std::size_t before = peak();
  EXPECT_THAT(message_of_input_error([&] { read_mesh(file, 1); }), HasSubstr("more than a file of its size"));
  EXPECT_LT(peak() - before, 64 * std::filesystem::file_size(file) + (64u << 20));
}

TEST(Bombs, an_array_that_holds_other_than_promised_is_refused_before_it_is_unpacked) {
  const TestFolder folder;
  const auto file = folder.write("liar.vtp", vtp_of(zeros(std::size_t{512} << 20), 3));
  const std::size_t before = peak();
  EXPECT_THAT(message_of_input_error([&] { read_mesh(file, 1); }), HasSubstr("where there must be 9"));
  EXPECT_LT(peak() - before, 64u << 20);
}

TEST(Bombs, within_its_budget_a_reader_keeps_to_its_memory) {
  const TestFolder folder;
  const std::size_t bytes = std::size_t{1} << 20;
  const auto file = folder.write("small.vtp", vtp_of(zeros(bytes - bytes % 3), bytes / 3, "Int8"));
  const std::size_t before = peak();
  try {
    read_mesh(file, 1);
  } catch (const InputError&) {
    // A megabyte is not a multiple of three coordinates.
  }
  EXPECT_LT(peak() - before, 64 * std::filesystem::file_size(file) + (64u << 20));
}

TEST(Bombs, counts_that_are_none_are_told_of) {
  const TestFolder folder;
  for (const char* count : {"-1", "99999999999999999999", "3.5", "x"}) {
    std::string text = vtp_of(zeros(1 << 20), 3);
    const std::size_t at = text.find("\"3\"");
    text.replace(at, 3, fmt::format("\"{}\"", count));
    EXPECT_THAT(message_of_input_error([&] { read_mesh(folder.write("a.vtp", text), 1); }), HasSubstr("is not a count"))
        << count;
  }
}

TEST(Bombs, a_face_of_a_hundred_thousand_corners_is_refused) {
  const TestFolder folder;
  std::string text, face = "f";
  for (int i = 0; i < 100'000; ++i) {
    text += fmt::format("v {} {} 0\n", i, i % 7);
    face += fmt::format(" {}", i + 1);
  }
  EXPECT_THAT(message_of_input_error([&] { read_mesh(folder.write("a.obj", text + face + "\n"), 1); }),
              HasSubstr("has 100000 corners; 1000 are the most"));
}
