#include "stack/mapping/map_file.h"

#include <octomap/OcTree.h>

#include <ostream>

#include "base/error.h"

namespace alula::stack::mapping {

void WriteOctoMap(const ClearanceField& field, std::ostream& out) {
  const GridShape& shape = field.shape;
  octomap::OcTree tree(shape.cell);
  for (int i = 0; i < shape.size[0]; ++i) {
    for (int j = 0; j < shape.size[1]; ++j) {
      for (int k = 0; k < shape.size[2]; ++k) {
        const CellState state = field.StateOf(shape.Index(i, j, k));
        if (state == CellState::kUnknown) continue;
        const base::Vec3 p_O = shape.Centre(i, j, k);
        const float log_odds =
            state == CellState::kOccupied ? tree.getClampingThresMaxLog() : tree.getClampingThresMinLog();
        tree.setNodeValue(p_O.x(), p_O.y(), p_O.z(), log_odds, true);
      }
    }
  }
  if (tree.getRoot() != nullptr) tree.updateInnerOccupancy();
  tree.prune();
  // The header of octomap's own writeBinary, which would also talk on stderr.
  out << "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
      << "id " << tree.getTreeType() << "\nsize " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n";
  if (tree.getRoot() != nullptr) tree.writeBinaryNode(out, tree.getRoot());
  if (!out) throw base::FaultError("map_write", "the octree could not be written");
}

}  // namespace alula::stack::mapping
