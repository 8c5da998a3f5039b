#include "core/io/summary.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <fstream>
#include <unistd.h>

#include "core/error.hpp"

namespace ballast::io {

void sync_to_disc(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int cause = errno;
  if (descriptor >= 0)
    ::close(descriptor);
  if (!synced)
    throw Error(
        fmt::format("{}: cannot be flushed to the disc ({}). Free space or choose another --out.",
                    path.string(),
                    std::strerror(cause)));
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  if (path.has_parent_path())
    std::filesystem::create_directories(path.parent_path());
  const std::filesystem::path temporary = path.string() + ".tmp";
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.flush();
    if (!out)
      throw Error(fmt::format("{}: cannot be written ({}). Free space, or choose another --out.",
                              temporary.string(),
                              std::strerror(errno)));
  }
  sync_to_disc(temporary);
  std::filesystem::rename(temporary, path);
}

} // namespace ballast::io
