#include "crampon/output/picture_mark.hpp"

#include <libdeflate.h>

#include <cstdint>
#include <fstream>
#include <string_view>

namespace crampon {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view mark = "tEXtSoftware\0Crampon"sv;  // type and content of a chunk (PNG specification, 11.3.4.3)
constexpr std::size_t first_chunk_end = 33;                   // signature of 8 bytes, header chunk of 25

void append_number(std::string& out, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(number >> shift & 0xffU);
}

}  // namespace

void mark_picture(std::string& png) {
  std::string chunk;
  append_number(chunk, static_cast<std::uint32_t>(mark.size() - 4));  // the type does not count
  chunk += mark;
  append_number(chunk, libdeflate_crc32(0, mark.data(), mark.size()));
  png.insert(first_chunk_end, chunk);
}

bool is_marked_picture(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(first_chunk_end + 4 + mark.size(), '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return file.good() && start.ends_with(mark);
}

}  // namespace crampon
