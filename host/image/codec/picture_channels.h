// Which channels of a file are the picture: by name, never by position. OpenEXR keeps channels in
// alphabetical order and layers beside each other, "diffuse.R" or a part of the file called "diffuse".
#pragma once

#include <string>
#include <vector>

namespace whittle {

/// One part of a file (a subimage, in OpenImageIO's words).
struct FilePart {
  std::string name;                   ///< empty where parts have none
  std::vector<std::string> channels;  ///< in the file's order; empty: holds no flat picture
};

/// Three channels, red, green and blue, or a single grey one.
struct PictureChannels {
  int part = 0;
  std::vector<int> channels;  ///< of FilePart::channels
  bool hasAlpha = false;      ///< beside them, in any layer of the part
};

/// Red, green and blue of the unnamed layer, else of the only layer that has them; else the grey channel Y in
/// the same sense; else the three components X, Y, Z of the only layer that has those (normals); else the
/// only channel beside alpha. Upper and lower case are the same. Throws InputError naming `file` and the
/// layers or channels where there is no such choice or more than one.
PictureChannels choosePicture(const std::vector<FilePart>& parts, const std::string& file);

}  // namespace whittle
