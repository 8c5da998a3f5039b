// Impulses of a pair of surfaces whose feet are known: the method is ale/layers/contact.hpp's.
#include "ale/layers/contact_parts.hpp"
#include "ale/layers/contact_vector.hpp"
#include "ale/layers/layer_load.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

template <int Dim> using Vec = std::array<double, Dim>;
template <int Dim> using Surfaces = std::array<ContactSurface<Dim>*, 2>;

/// What the opening of a node has to be at least.
double asked_opening(double gap, double opening, double dt, double push_out) {
  return gap >= 0 ? -gap / dt : std::min(push_out * -gap / dt, std::max(0.0, -opening));
}

template <int Dim> Eigen::Matrix<double, Dim, Dim> added_mass(const ContactSurface<Dim>& s, int node) {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  return s.added != nullptr ? Matrix(s.added + node * Dim * Dim) : Matrix::Zero();
}

/// Change of a node's velocity by an impulse on it and on what moves with it.
template <int Dim> Vec<Dim> response(const ContactSurface<Dim>& s, int node, const Vec<Dim>& impulse) {
  const auto change = pushed<Dim>(s.mass[node], added_mass(s, node), Eigen::Matrix<double, Dim, 1>(impulse.data()), s.held != nullptr ? s.held[node] : 0U);
  Vec<Dim> out;
  std::copy(change.data(), change.data() + Dim, out.begin());
  return out;
}

template <int Dim> class Solver {
public:
  Solver(const Surfaces<Dim>& surfaces, double dt, const ContactSettings& settings, ContactState<Dim>& state) : surfaces_(surfaces), dt_(dt), settings_(settings), state_(state) {}

  ContactReport run() {
    ContactReport report;
    clear();
    measure(report);
    find_neighbours<Dim>(surfaces_, state_);
    list(false, settings_.push_out);
    if (state_.points.empty()) {
      return report;
    }
    iterate(report, settings_.push_out);
    account(report);
    if (pushes_ && state_.taken + report.loss < report.friction_loss) {
      restore_velocities();
      clear();
      list(false, 0);
      iterate(report, 0);
      account(report);
    }
    state_.taken += report.loss - report.friction_loss;
    return report;
  }

private:
  void clear() {
    state_.points.clear();
    pushes_ = false;
    for (ContactCandidate<Dim>& c : state_.candidates) {
      c.listed = false;
    }
    for (std::size_t s = 0; s < 2; ++s) {
      std::fill(state_.touched[s].begin(), state_.touched[s].end(), char(0));
      std::fill(state_.listed[s].begin(), state_.listed[s].end(), char(0));
    }
  }

  void measure(ContactReport& report) const {
    for (std::size_t s = 0; s < 2; ++s) {
      const ContactTrack<Dim>& t = state_.tracks[s];
      for (std::size_t n = 0; n < t.gap.size(); ++n) {
        report.behind += t.status[n] == FootStatus::behind ? 1 : 0;
        if (t.status[n] != FootStatus::front) {
          continue;
        }
        if (-t.gap[n] > report.deepest) {
          report.deepest = -t.gap[n];
          const Vec<Dim> x = surfaces_[s]->place(static_cast<int>(n));
          std::copy(x.begin(), x.end(), report.deepest_at.begin());
        }
        if (t.gap[n] + dt_ * t.opening[n] < 0) {
          report.closing = std::max(report.closing, -dt_ * t.opening[n]);
        }
      }
    }
  }

  /// Lists the nodes that ask for more than they have; `driven`: among those near an impulse that are not listed yet.
  void list(bool driven, double push_out) {
    for (std::size_t s = 0; s < 2; ++s) {
      const ContactTrack<Dim>& t = state_.tracks[s];
      for (int node = 0; node < surfaces_[s]->node_count(); ++node) {
        const auto n = static_cast<std::size_t>(node);
        if (t.status[n] != FootStatus::front || state_.listed[s][n] != 0 || (driven && !near_impulse(s, node, t.segment[n]))) {
          continue;
        }
        if (t.current[n] == 0 && driven) { // its foot is of an earlier step
          track_node(state_.seen_from(s, surfaces_, dt_), node, state_.tracks[s]);
        }
        if (t.status[n] == FootStatus::front && t.current[n] != 0) {
          state_.listed[s][n] = list_foot({s, node, t.segment[n], t.local[n], t.normal_at(n), t.gap[n], t.opening[n], false}, driven, push_out) ? 1 : 0;
        }
      }
    }
    for (ContactCandidate<Dim>& c : state_.candidates) {
      if (!c.listed && (!driven || near_impulse(c.side, c.node, c.segment))) {
        c.listed = list_foot(c, driven, push_out);
      }
    }
  }

  bool list_foot(const ContactCandidate<Dim>& c, bool driven, double push_out) {
    const double asked = asked_opening(c.gap, c.opening, dt_, push_out);
    const double opening = driven ? dot(relative_velocity<Dim>(*surfaces_[c.side], c.node, *surfaces_[1 - c.side], c.segment, c.local), c.normal) : c.opening;
    if (!(opening < asked)) {
      return false;
    }
    pushes_ = pushes_ || asked > 0;
    state_.points.push_back(make_point(c, asked));
    return true;
  }

  bool near_impulse(std::size_t s, int node, int segment) const {
    bool near = state_.touched[s][static_cast<std::size_t>(node)] != 0;
    for (const int c : surfaces_[1 - s]->corners_of(segment)) {
      near = near || state_.touched[1 - s][static_cast<std::size_t>(c)] != 0;
    }
    return near;
  }

  ContactPoint<Dim> make_point(const ContactCandidate<Dim>& from, double asked) {
    const ContactSurface<Dim>&a = *surfaces_[from.side], &b = *surfaces_[1 - from.side];
    ContactPoint<Dim> p{from.side, from.node, b.corners_of(from.segment), corner_shares<Dim>(from.local), from.normal, asked, 0, 0, 0, {}, {}, 0, {}};
    for (std::size_t d = 0; d < Dim; ++d) {
      const int axis = static_cast<int>(d);
      p.gives[d] = a.inverse_mass(p.node, axis);
      double w = a.weight * p.gives[d], u = a.fixed_at(d, p.node);
      for (std::size_t c = 0; c < p.corners; ++c) {
        p.corner_gives[d][c] = p.share[c] * b.inverse_mass(p.corner[c], axis);
        w += p.share[c] * b.weight * p.corner_gives[d][c];
        u -= p.share[c] * b.fixed_at(d, p.corner[c]);
      }
      p.per_impulse += p.normal[d] * p.normal[d] * w;
      p.per_slip = std::max(p.per_slip, w);
      p.fixed += p.normal[d] * u;
    }
    if (loaded()) {
      p.per_impulse = a.weight * dot(p.normal, response<Dim>(a, p.node, p.normal));
      for (std::size_t c = 0; c < p.corners; ++c) {
        p.per_impulse += p.share[c] * p.share[c] * b.weight * dot(p.normal, response<Dim>(b, p.corner[c], p.normal));
      }
    }
    return p;
  }

  bool loaded() const { return surfaces_[0]->added != nullptr || surfaces_[1]->added != nullptr; }

  void restore_velocities() {
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t n = 0; n < state_.touched[s].size(); ++n) {
        for (std::size_t d = 0; d < Dim && state_.touched[s][n] != 0; ++d) {
          surfaces_[s]->velocity[d][n] = state_.before[s][d][n];
        }
      }
    }
  }
  void touch(std::size_t s, int node) {
    const auto n = static_cast<std::size_t>(node);
    if (state_.touched[s][n] == 0) {
      state_.touched[s][n] = 1;
      for (std::size_t d = 0; d < Dim; ++d) {
        state_.before[s][d][n] = surfaces_[s]->velocity[d][node];
      }
    }
  }

  void iterate(ContactReport& report, double push_out) {
    report.sweeps = 0;
    double first = 0;
    for (int round = 0; round < settings_.rounds; ++round) {
      double worst = 0;
      for (int sweep = 0; sweep < settings_.sweeps; ++sweep) {
        worst = 0;
        for (ContactPoint<Dim>& p : state_.points) {
          worst = std::max(worst, relax(p));
        }
        ++report.sweeps;
        first = std::max(first, worst);
        if (worst <= settings_.tolerance * first) {
          break;
        }
      }
      report.violation = dt_ * worst;
      const std::size_t known = state_.points.size();
      if (round + 1 < settings_.rounds) {
        list(true, push_out);
      }
      if (state_.points.size() == known) {
        break;
      }
    }
  }

  /// Velocity of the node relative to its foot.
  Vec<Dim> slip(const ContactPoint<Dim>& p, double weight_a, double weight_b) const {
    const ContactSurface<Dim>&a = *surfaces_[p.side], &b = *surfaces_[1 - p.side];
    Vec<Dim> u;
    for (std::size_t d = 0; d < Dim; ++d) {
      double foot = 0;
      for (std::size_t c = 0; c < p.corners; ++c) {
        foot += p.share[c] * b.velocity[d][p.corner[c]];
      }
      u[d] = weight_a * a.velocity[d][p.node] - weight_b * foot;
    }
    return u;
  }

  void push(const ContactPoint<Dim>& p, const Vec<Dim>& impulse) {
    const ContactSurface<Dim>&a = *surfaces_[p.side], &b = *surfaces_[1 - p.side];
    touch(p.side, p.node);
    for (const int c : p.corner) {
      touch(1 - p.side, c);
    }
    if (loaded()) {
      const Vec<Dim> own = response<Dim>(a, p.node, impulse);
      for (std::size_t d = 0; d < Dim; ++d) {
        a.velocity[d][p.node] += own[d];
      }
      for (std::size_t c = 0; c < p.corners; ++c) {
        const Vec<Dim> other = response<Dim>(b, p.corner[c], impulse);
        for (std::size_t d = 0; d < Dim; ++d) {
          b.velocity[d][p.corner[c]] -= p.share[c] * other[d];
        }
      }
      return;
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      a.velocity[d][p.node] += impulse[d] * p.gives[d];
      for (std::size_t c = 0; c < p.corners; ++c) {
        b.velocity[d][p.corner[c]] -= impulse[d] * p.corner_gives[d][c];
      }
    }
  }

  /// One point's turn; the change of its velocities that it needed, m/s.
  double relax(ContactPoint<Dim>& p) {
    const Vec<Dim> u = slip(p, surfaces_[p.side]->weight, surfaces_[1 - p.side]->weight);
    double opening = p.fixed;
    for (std::size_t d = 0; d < Dim; ++d) {
      opening += p.normal[d] * u[d];
    }
    const double total = std::max(0.0, p.impulse + (p.asked - opening) / p.per_impulse), change = total - p.impulse;
    double needed = std::abs(change) * p.per_impulse;
    if (change != 0) {
      Vec<Dim> impulse;
      for (std::size_t d = 0; d < Dim; ++d) {
        impulse[d] = change * p.normal[d];
      }
      push(p, impulse);
      p.impulse = total;
    }
    if (settings_.friction > 0) {
      needed = std::max(needed, rub(p));
    }
    return needed;
  }

  /// Friction of one point: towards no slip, total at most mu times the pressing one.
  double rub(ContactPoint<Dim>& p) {
    const Vec<Dim> u = slip(p, 1, 1);
    double along = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      along += u[d] * p.normal[d];
    }
    Vec<Dim> total, change;
    double square = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      total[d] = p.friction[d] - (u[d] - along * p.normal[d]) / p.per_slip;
      square += total[d] * total[d];
    }
    const double most = settings_.friction * p.impulse, scale = square > most * most ? most / std::sqrt(square) : 1.0;
    double size = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      change[d] = scale * total[d] - p.friction[d];
      p.friction[d] = scale * total[d];
      size += change[d] * change[d];
    }
    if (size > 0) {
      push(p, change);
    }
    return std::sqrt(size) * p.per_slip;
  }

  double mean_velocity(std::size_t s, std::size_t d, int node) const {
    const ContactSurface<Dim>& a = *surfaces_[s];
    return 0.5 * (a.old_velocity(d, node, dt_, state_.before[s][d][static_cast<std::size_t>(node)]) + a.velocity[d][node]);
  }

  double friction_work(const ContactPoint<Dim>& p) const {
    double work = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      double u = mean_velocity(p.side, d, p.node);
      for (std::size_t c = 0; c < p.corners; ++c) {
        u -= p.share[c] * mean_velocity(1 - p.side, d, p.corner[c]);
      }
      work += p.friction[d] * u;
    }
    return work;
  }

  void account(ContactReport& report) const {
    report.loss = report.friction_loss = report.impulse = 0;
    report.active = 0;
    report.impulse_sum = {0, 0, 0};
    for (const ContactPoint<Dim>& p : state_.points) {
      report.active += p.impulse > 0 ? 1 : 0;
      report.impulse += p.impulse;
      report.friction_loss -= settings_.friction > 0 ? friction_work(p) : 0.0;
    }
    const bool held = surfaces_[0]->held != nullptr || surfaces_[1]->held != nullptr;
    for (std::size_t s = 0; s < 2; ++s) {
      const ContactSurface<Dim>& a = *surfaces_[s];
      for (int node = 0; node < a.node_count(); ++node) {
        const auto n = static_cast<std::size_t>(node);
        if (state_.touched[s][n] == 0) {
          continue;
        }
        const auto added = added_mass(a, node);
        Eigen::Matrix<double, Dim, 1> gained;
        for (std::size_t d = 0; d < Dim; ++d) {
          gained[static_cast<Eigen::Index>(d)] = a.velocity[d][node] - state_.before[s][d][n];
        }
        const Eigen::Matrix<double, Dim, 1> carried = added * gained;
        for (std::size_t d = 0; d < Dim; ++d) {
          const auto at = static_cast<Eigen::Index>(d);
          const double change = a.mass[node] * gained[at] + carried[at];
          report.loss -= change * mean_velocity(s, d, node);
          report.impulse_sum[d] += held ? change : 0;
        }
      }
    }
  }

  Surfaces<Dim> surfaces_;
  double dt_;
  const ContactSettings& settings_;
  ContactState<Dim>& state_;
  bool pushes_ = false;
};

} // namespace

template <int Dim> ContactReport apply_impulses(const std::array<ContactSurface<Dim>*, 2>& surfaces, double dt, const ContactSettings& settings, ContactState<Dim>& state) {
  return Solver<Dim>(surfaces, dt, settings, state).run();
}

template ContactReport apply_impulses<2>(const std::array<ContactSurface<2>*, 2>&, double, const ContactSettings&, ContactState<2>&);
template ContactReport apply_impulses<3>(const std::array<ContactSurface<3>*, 2>&, double, const ContactSettings&, ContactState<3>&);

} // namespace ballast
