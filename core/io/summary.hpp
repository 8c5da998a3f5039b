// Small whole files (summary.json, .pvd, .vtm) that a reader must never find half written:
// write to a temporary name beside the target, fsync, rename.
#pragma once

#include <filesystem>
#include <string_view>

namespace ballast::io {

/// Replaces `path` by `text` in one step; parent folders are made. Throws Error naming path and
/// cause.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

/// Flushes the file at `path` to the disc. Throws Error.
void sync_to_disc(const std::filesystem::path& path);

} // namespace ballast::io
