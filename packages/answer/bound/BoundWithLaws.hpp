#pragma once
#include <suture/answer/bound/ErrorBound.hpp>

namespace suture {

/// errorBound() with the laws of the contacts, from which constant bounds of Tresca friction follow. With friction, s the slip of v in the
/// load step, t the friction stress in tau, and g its bound, |t| <= g,
///     2 integral of (g |s| - t . s)
/// is added, and u minimises its potential energy plus the integral of g |s|: with Tresca friction of a constant bound on sides that all
/// touch, the solution of the scene; otherwise that for given g, and the bound is an estimate. On elastic supports of stiffness k, and
/// springs of softened contacts, the integral of |traction of tau + k v|^2 / k is added, and energies include theirs. Collective.
ErrorBound errorBound(const Comm& comm, const BoundedSolution& solution, const ContactLaws& laws, int sweeps = 2);

}  // namespace suture
