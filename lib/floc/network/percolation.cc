#include "floc/network/percolation.h"

#include <algorithm>

#include "floc/network/components.h"

namespace floc {
namespace {

/// Block of a network: either a maximal set of contacts in which any two contacts lie on a common loop, or a single
/// contact that lies on no loop.
struct Block {
  std::vector<int> contacts;
  std::vector<int> grains;
  bool winds = false;  // whether the block contains a loop around the cell, or from one wall to another
  bool held = false;   // whether the block contains a loop that passes through walls
};

/// Finds the blocks of a network (see Block) by depth-first search (Hopcroft and Tarjan). Several contacts between the
/// same two grains, and contacts of a grain with its own image, are different contacts. All walls together count as one
/// additional grain. The upper walls count as periodic images of the lower walls.
template <int Dim>
class BlockSearch {
 public:
  BlockSearch(const ContactNetwork<Dim>& network, const Adjacency& of)
      : network_(network),
        of_(of),
        depth_(network.n_grains + 1, 0),
        low_(network.n_grains + 1, 0),
        image_(network.n_grains + 1, CellCount<Dim>::Zero()),
        seen_(network.contacts.size(), false),
        last_block_(network.n_grains + 1, -1) {
    of_.emplace_back();
    for (int c = 0; c < static_cast<int>(network.contacts.size()); ++c)
      if (network.contacts[c].on_wall()) of_.back().push_back(c);
    for (int i = 0; i <= network.n_grains; ++i)
      if (depth_[i] == 0) search(i);
  }
  std::vector<Block> take() { return std::move(blocks_); }

 private:
  struct Visit {
    int grain;
    int contact;           // contact through which the search has reached the grain; -1 for the root
    std::size_t next = 0;  // number of contacts of the grain that the search has already followed
  };

  void search(int root) {
    depth_[root] = low_[root] = 1;
    std::vector<Visit> path{{root, -1}};
    while (!path.empty()) {
      Visit& visit = path.back();
      if (visit.next < of_[visit.grain].size()) {
        const int c = of_[visit.grain][visit.next++];
        if (!seen_[c]) follow(visit.grain, c, path);
        continue;
      }
      const Visit done = visit;
      path.pop_back();
      if (path.empty()) break;
      const int parent = path.back().grain;
      low_[parent] = std::min(low_[parent], low_[done.grain]);
      if (low_[done.grain] >= depth_[parent]) close_block(done.contact);
    }
  }

  void follow(int grain, int c, std::vector<Visit>& path) {
    const NetworkContact<Dim>& contact = network_.contacts[c];
    const bool forward = contact.i == grain;
    const int other = forward ? second(contact) : contact.i;
    seen_[c] = true;
    if (other == grain) {
      blocks_.push_back({{c}, {grain}, contact.image != Vec<Dim, int>(Vec<Dim, int>::Zero()), false});
      return;
    }
    open_.push_back(c);
    if (depth_[other] != 0) {
      low_[grain] = std::min(low_[grain], depth_[other]);
      return;
    }
    depth_[other] = low_[other] = depth_[grain] + 1;
    image_[other] = image_[grain] + (forward ? 1 : -1) * cells(contact);
    path.push_back({other, c});
  }

  /// Completes a block. It consists of the contact `first` and all contacts that the search has followed after it.
  void close_block(int first) {
    Block block;
    const int number = static_cast<int>(blocks_.size());
    int c = -1;
    while (c != first) {
      c = open_.back();
      open_.pop_back();
      const NetworkContact<Dim>& contact = network_.contacts[c];
      block.contacts.push_back(c);
      block.winds = block.winds || image_[contact.i] + cells(contact) != image_[second(contact)];
      block.held = block.held || contact.on_wall();
      for (const int grain : {contact.i, second(contact)})
        if (last_block_[grain] != number) last_block_[grain] = number, block.grains.push_back(grain);
    }
    block.held = block.held && block.contacts.size() > 1;
    blocks_.push_back(std::move(block));
  }

  int second(const NetworkContact<Dim>& contact) const {
    return contact.on_wall() ? network_.n_grains : contact.j;
  }

  static CellCount<Dim> cells(const NetworkContact<Dim>& contact) {
    CellCount<Dim> cells = contact.image.template cast<std::int64_t>();
    if (!contact.on_wall()) return cells;
    // The normal of a wall is along an axis, and its components are 0, 1 or -1.
    constexpr double kAlong = 0.5;
    for (int a = 0; a < Dim; ++a) cells[a] += contact.normal()[a] > kAlong;
    return cells;
  }

  const ContactNetwork<Dim>& network_;
  Adjacency of_;
  std::vector<int> depth_;  // for each grain, its depth in the search tree, from 1; 0 if not reached
  std::vector<int> low_;    // for each grain, the smallest depth among the grains in contact with its subtree
  std::vector<CellCount<Dim>> image_;
  std::vector<bool> seen_;
  std::vector<int> open_;  // contacts that do not yet belong to a block
  std::vector<int> last_block_;
  std::vector<Block> blocks_;
};

/// Removes dead ends, block by block from the tips. A block is a tip if it contains no loop around the cell or through
/// walls, and shares at most one grain with the remaining blocks.
/// @param n_nodes  number of grains, plus one for the walls
/// @return for each block, whether it was removed
std::vector<bool> hanging(const std::vector<Block>& blocks, int n_nodes) {
  std::vector<std::vector<int>> of(n_nodes);
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b)
    for (const int grain : blocks[b].grains) of[grain].push_back(b);
  std::vector<int> n_left(n_nodes);
  for (int i = 0; i < n_nodes; ++i) n_left[i] = static_cast<int>(of[i].size());
  // A joint of a block is a grain that also belongs to other remaining blocks. Blocks and joints form trees; a block
  // with at most one joint is therefore a tip.
  std::vector<int> n_joints(blocks.size(), 0);
  std::vector<int> tips;
  const auto is_tip = [&](int b) { return !blocks[b].winds && !blocks[b].held && n_joints[b] <= 1; };
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b) {
    for (const int grain : blocks[b].grains) n_joints[b] += n_left[grain] > 1 ? 1 : 0;
    if (is_tip(b)) tips.push_back(b);
  }
  std::vector<bool> gone(blocks.size(), false);
  while (!tips.empty()) {
    const int tip = tips.back();
    tips.pop_back();
    if (gone[tip]) continue;
    gone[tip] = true;
    for (const int grain : blocks[tip].grains) {
      // If a single block remains at a grain, the grain is no longer a joint of this block. If two or more blocks
      // remain at the grain, it is still a joint of these blocks.
      if (--n_left[grain] != 1) continue;
      const int last = *std::find_if(of[grain].begin(), of[grain].end(), [&](int b) { return !gone[b]; });
      --n_joints[last];
      if (is_tip(last)) tips.push_back(last);
    }
  }
  return gone;
}

}  // namespace

template <int Dim>
Percolation find_percolation(const ContactNetwork<Dim>& network) {
  const Adjacency of = contacts_of_grains(network);
  const std::size_t n = network.contacts.size();
  Percolation result{std::vector<bool>(n, false), std::vector<bool>(n, false)};
  for (const Component<Dim>& part : find_components(network, of, std::vector<bool>(n, true)))
    result.n_directions = std::max(result.n_directions, static_cast<int>(part.winding.size()));
  const std::vector<Block> blocks = BlockSearch<Dim>(network, of).take();
  const std::vector<bool> gone = hanging(blocks, network.n_grains + 1);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const int c : blocks[b].contacts) {
      result.scalar_backbone[c] = blocks[b].winds;
      result.dead_end[c] = gone[b];
    }
  return result;
}

template Percolation find_percolation(const ContactNetwork<2>&);
template Percolation find_percolation(const ContactNetwork<3>&);

}  // namespace floc
