// SPDX-License-Identifier: BSD-3-Clause
#include "closing/global_layout.h"

#include <utility>

namespace sslcd {

const LayoutIndex& GlobalLayout::Update(const MapState& state, const PassMap& passes,
                                        double global_end_m) {
  LayoutChanges changes =
      PassLayouts(passes, state).ChangesBefore(global_end_m, min_sightings_, mark_);
  if (!index_ || changes.all)
    index_.emplace(std::move(changes.objects), max_pair_m_, reach_m_);
  else
    index_->Update(changes.objects, changes.gone);
  return *index_;
}

}  // namespace sslcd
