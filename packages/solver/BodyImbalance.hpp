#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/precond/Preconditioner.hpp>

namespace suture {

/// Energy norm below which a body carries nothing, relative to its largest so far.
constexpr double kNegligibleEnergyNorm = 1e-12;
/// Fraction of the total or cluster energy below which the energy of a body is neglected.
constexpr double kPassive = 1e-12;
/// Accepted imbalance of a body's forces relative to the residual tolerance: a tenth of the limit of the verdict.
constexpr double kImbalance = 10.0;
/// Safety factor on the tolerance that would suffice if all residuals decreased at the same rate.
constexpr double kSharper = 0.7;

/// Imbalance of the loads and pair forces on a body in the motions stopped only by contact, relative to the forces transmitted by the body;
/// the maximum over all bodies. Forces transverse to these motions are included through the deformation of the body, and a body without
/// loads is assigned a fraction of its neighbours' forces: a remainder in a motion that nothing drives is their round-off. Local; the same
/// on all ranks.
/// \param force    forces of each pair: normal, and tangential if laws restrict sliding
/// \param energy   U.S U of each part, twice its deformation energy
/// \param largest  its largest value in the run; sets the round-off level
double bodyImbalance(const ContactBodies& bodies, const Matrix& force, const Vector& energy, const Vector& largest);

/// Largest residual norm of a body relative to its own energy.
/// \param own    product r.M^-1 r of each part
/// \param least  lower bound of the energy of each part, twice
double bodyResidual(const Vector& own, const Vector& energy, const Vector& largest, const Vector& least);
/// Products r.M^-1 r per part. Collective.
Vector productsByPart(const ContactProblem& contact, const Preconditioner& preconditioner, const MultiVector& r);

}  // namespace suture
