// What geometry of a run is written for other programs.
#pragma once

#include "base/words.h"

namespace billow::cli {

/// pc2: Blender's point cache; mdd: LightWave's, which Houdini, Maya and Blender read; obj, ply: a mesh a frame; vtp:
/// VTK's, with velocities and strain, for ParaView; glb: one animated glTF file of everything.
enum class CacheFormat { pc2, mdd, obj, ply, vtp, glb };
Words<CacheFormat> words(CacheFormat);

}  // namespace billow::cli
