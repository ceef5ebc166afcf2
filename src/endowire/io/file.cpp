#include "endowire/io/file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <span>
#include <system_error>

#include "endowire/base/error.hpp"
#include "endowire/vessel/hash.hpp"

namespace endowire::io {

using base::InputError;
namespace fs = std::filesystem;

std::string read_file(const fs::path& path, std::uintmax_t max_bytes) {
  const std::string name = one_line(path.string());
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{}: no such file", name));
  if (fs::is_directory(status)) throw InputError(fmt::format("{}: is a folder; must be a file", name));
  // A pipe or a device has no size to be trusted: only what can be read counts.
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be opened for reading", name));
  std::string bytes;
  if (fs::is_regular_file(status)) {
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error && size > max_bytes)
      throw InputError(fmt::format("{}: is {} bytes long; must be <= {} bytes", name, size, max_bytes));
    if (!error) bytes.reserve(static_cast<std::size_t>(size));
  }
  constexpr std::size_t chunk = std::size_t{1} << 20;
  while (in) {
    const std::size_t old = bytes.size();
    bytes.resize(old + chunk);
    in.read(bytes.data() + old, static_cast<std::streamsize>(chunk));
    bytes.resize(old + static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > max_bytes)
      throw InputError(fmt::format("{}: is longer than {} bytes, the most that is read", name, max_bytes));
  }
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read to its end", name));
  if (bytes.empty()) throw InputError(fmt::format("{}: is empty", name));
  return bytes;
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  static std::atomic<unsigned> counter{0};  // names temporary files apart within one process, nothing else
  fs::path temporary = path;
  temporary += fmt::format(".tmp-{}-{}", ::getpid(), counter++);
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      std::error_code ignored;
      fs::remove(temporary, ignored);
      throw InputError(fmt::format("{}: cannot be written", one_line(path.string())));
    }
  }
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw InputError(fmt::format("{}: cannot be written ({})", one_line(path.string()), error.message()));
  }
}

std::uint64_t content_hash(std::string_view bytes) {
  vessel::ContentHash hash;
  hash.add_bytes(std::as_bytes(std::span(bytes)).data(), bytes.size());
  return hash.value();
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  return line;
}

}  // namespace endowire::io
