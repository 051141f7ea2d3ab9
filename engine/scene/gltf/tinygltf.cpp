// The one translation unit that holds tinygltf's code.
#include <fstream> // tinygltf writes files even where it reads none
#define TINYGLTF_IMPLEMENTATION
#include "engine/scene/gltf/model.h"
