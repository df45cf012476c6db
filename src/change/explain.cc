// SPDX-License-Identifier: BSD-3-Clause
#include "change/explain.h"

#include "change/learning.h"

namespace sslcd {
namespace {

// The looks of each session against those of the last one before.
std::vector<LookPair> CompareSessions(const Place& place) {
  std::vector<LookPair> looks;
  const SessionLooks* last = nullptr;
  for (const SessionLooks& session : place.sessions) {
    looks.push_back(last != nullptr ? Compare(*last, session, place.symmetry) : LookPair());
    if (session.sightings > 0) last = &session;
  }
  return looks;
}

PlaceHistory HistoryOf(const Place& place, const PlaceRecord& record,
                       const std::vector<MapObject>& objects) {
  PlaceHistory history;
  for (const int landmark : place.landmarks) history.landmarks.push_back(objects[landmark].id);
  history.label = place.label;
  history.T_world_object = place.T_world_object;
  history.dims = place.dims;
  history.map = place.map;
  for (std::size_t s = 0; s < record.visits.size(); ++s) {
    SessionEvidence evidence;
    for (const Visit& visit : record.visits[s]) {
      evidence.seen += visit.seen;
      evidence.expected += visit.expected;
    }
    evidence.probability = 1 - record.chain.states[s][kEmpty];
    history.sessions.push_back(evidence);
  }
  return history;
}

}  // namespace

struct SSLCD_HIDDEN MapHistory::Impl {
  std::vector<PlaceHistory> places;
  std::map<std::string, ChangeRates> rates;
  std::vector<PlaceRecord> records;
};

MapHistory::MapHistory(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
const std::vector<PlaceHistory>& MapHistory::places() const { return impl_->places; }
const std::map<std::string, ChangeRates>& MapHistory::rates() const { return impl_->rates; }

PlaceOutcome MapHistory::Between(int place, int from, int to) const {
  const PlaceRecord& record = impl_->records.at(place);
  return sslcd::Between(record.chain, impl_->rates.at(impl_->places[place].label), from, to);
}

MapHistory Explain(const Sightings& sightings) {
  const std::vector<Place> places = FindPlaces(sightings);
  const std::vector<std::vector<Views>> views = CollectViews(sightings, places);
  const DetectionRate rate(places, views);
  auto impl = std::make_shared<MapHistory::Impl>();
  for (std::size_t i = 0; i < places.size(); ++i) {
    PlaceRecord record;
    for (const Views& session : views[i])
      record.visits.push_back(VisitsOf(session, places[i].label, rate));
    record.looks = CompareSessions(places[i]);
    impl->records.push_back(std::move(record));
  }
  impl->rates = LearnChanges(places, impl->records).rates;
  for (std::size_t i = 0; i < places.size(); ++i)
    impl->places.push_back(HistoryOf(places[i], impl->records[i], sightings.world().objects));
  return MapHistory(std::move(impl));
}

}  // namespace sslcd
