#include "endowire/io/inflate.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

#include "endowire/base/error.hpp"

namespace endowire::io {

namespace {

constexpr std::size_t chunk = std::size_t{1} << 20;
constexpr int gzip_or_zlib =
    15 + 32;  // the largest window; the stream's own header tells which of the two it is

/// Ends a stream of zlib whatever happens.
struct Stream {
  z_stream z{};
  bool open = inflateInit2(&z, gzip_or_zlib) == Z_OK;
  Stream() = default;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    if (open) inflateEnd(&z);
  }
};

}  // namespace

bool is_gzip(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

std::string inflate(std::string_view packed, std::size_t size, const std::string& file_label) {
  Stream stream;
  std::string out;
  std::size_t taken = 0;
  int state = stream.open ? Z_OK : Z_MEM_ERROR;
  while (state == Z_OK && out.size() < size) {
    if (stream.z.avail_in == 0) {
      const std::size_t more =
          std::min<std::size_t>(packed.size() - taken, std::numeric_limits<uInt>::max() / 2);
      if (more == 0) break;
      stream.z.next_in =
          reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + taken));  // zlib only reads it
      stream.z.avail_in = static_cast<uInt>(more);
      taken += more;
    }
    const std::size_t old = out.size();
    const std::size_t room = std::min(chunk, size - old);
    out.resize(old + room);
    stream.z.next_out = reinterpret_cast<Bytef*>(out.data() + old);
    stream.z.avail_out = static_cast<uInt>(room);
    state = ::inflate(&stream.z, Z_NO_FLUSH);
    out.resize(old + room - stream.z.avail_out);
    if (state == Z_BUF_ERROR) state = Z_OK;  // it wants more input
  }
  if (out.size() < size)
    throw base::InputError(fmt::format("{}: its packed data {} after {} bytes; must hold {}", file_label,
                                       state == Z_OK || state == Z_STREAM_END ? "end" : "are damaged",
                                       out.size(), size));
  return out;
}

}  // namespace endowire::io
