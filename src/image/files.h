// Files that appear whole or not at all. Devices and pipes, which cannot, are written through.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tyndall::image {

// Writes the bytes. Links are followed. A plain file, or one that is not there yet, gets them in a new file
// beside it that is flushed to the disk and renamed over it, with the permissions that it had; on any failure
// nothing is left behind and what was there stays. A device, a pipe or a standard stream of the program gets
// them as they are; a named pipe is waited for until something reads it, two seconds at most. Returns an
// error message fit for the user, or an empty string.
std::string write_file_whole(const std::string& path, std::span<const std::byte> bytes);
// The same with the bytes of all pieces in a row.
std::string write_file_whole(const std::string& path, std::span<const std::span<const std::byte>> pieces);

// A message when nothing can be written to `path` now, or an empty string. Leaves nothing behind.
std::string check_file_writable(const std::string& path);

// Whether a message of a write, here or in image.h, says that there is no room left: others would fail, too.
bool tells_of_full_disk(const std::string& message);

// Whether a file would appear there whole: it is no device, pipe or standard stream.
bool appears_whole(const std::string& path);

// The same text for all spellings of one file, through links, there or not there yet; empty where nothing can
// be overwritten: devices, standard streams, and what has no directory.
std::string file_identity(const std::string& path);

// Removes the files beside `path` that processes of this computer left when they were killed in
// write_file_whole().
void remove_leftovers(const std::string& path);

// Removes the file beside that is being written, if there is one: a signal handler may call it.
void remove_unfinished_file() noexcept;

}  // namespace tyndall::image
