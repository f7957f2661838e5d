#include "crampon/run/history_sampler.hpp"

namespace crampon {

template <int Dim>
void HistorySampler<Dim>::start(const Problem& problem, Observed& observed) {
  const Present<Dim> now(state_, work_, model_);
  std::vector<Diagnostic> errors;
  for (const auto& observer : observers_) observer->start({problem, now, observed, errors});
  if (!errors.empty()) throw InputError(std::move(errors));
}

template <int Dim>
std::vector<HistoryColumn> HistorySampler<Dim>::columns() const {
  const Present<Dim> now(state_, work_, model_);
  Cells cells(Cells::Of::header);
  for (const auto& observer : observers_) observer->look(now, cells);
  return std::move(cells).columns();
}

template <int Dim>
std::vector<double> HistorySampler<Dim>::row() const {
  const Present<Dim> now(state_, work_, model_);
  Cells cells(Cells::Of::row);
  for (const auto& observer : observers_) observer->look(now, cells);
  return std::move(cells).row();
}

template <int Dim>
std::vector<HistoryColumn> event_columns_of() {
  std::vector<HistoryColumn> c = {{"time", "s"}, {"event", "1"}, {"crack", "1"}, {"end", "1"}};
  for (int k = 0; k < Dim; ++k) c.push_back({std::string(1, "xyz"[k]), "m"});
  c.insert(c.end(), {{"G_I", "J/m2"},
                     {"G_II", "J/m2"},
                     {"angle", "rad"},
                     {"speed", "m/s"},
                     {"J", "J/m2"},
                     {"K_I", "Pa m^(1/2)"},
                     {"K_II", "Pa m^(1/2)"}});
  return c;
}

template <int Dim>
std::vector<double> event_row_of(const CrackEvent<Dim>& e) {
  std::vector<double> row = {e.time, static_cast<double>(e.kind), static_cast<double>(e.crack), static_cast<double>(e.end)};
  for (int k = 0; k < Dim; ++k) row.push_back(e.x[k]);
  for (const double value : {e.G_I, e.G_II, e.angle, e.speed, e.J, e.K_I, e.K_II}) row.push_back(value);
  return row;
}

#define CRAMPON_INSTANTIATE(DIM)                               \
  template class HistorySampler<DIM>;                          \
  template std::vector<HistoryColumn> event_columns_of<DIM>(); \
  template std::vector<double> event_row_of(const CrackEvent<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
