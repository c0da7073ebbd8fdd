#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/precond/Preconditioner.hpp>

namespace suture {

/// Energy norm of a body that carries nothing, relative to the largest that it has had.
constexpr double kNegligibleEnergyNorm = 1e-12;
/// Part of the energy of the whole, or of a cluster, below which a body has none of its own.
constexpr double kPassive = 1e-12;
/// Imbalance of a body's forces that is taken, in parts of the tolerance of residuals: a tenth of what the verdict allows.
constexpr double kImbalance = 10.0;
/// Factor on the tolerance that would do if all residuals fell alike.
constexpr double kSharper = 0.7;

/// Imbalance of the loads and pair forces on a body, in the motions that nothing but contact stops, beside the forces that pass through it:
/// the largest of all bodies. Forces across these motions count, too, by what deforms the body, and a body without loads has a share of its
/// neighbours': what is left along a motion that nothing drives is rounding of them. Local; the same on all ranks.
/// \param force    forces of each pair: the normal one, and those along the tangents where laws restrict sliding
/// \param energy   U.S U of each part, twice its deformation energy
/// \param largest  the largest that it has had in the run; sets what counts as rounding
double bodyImbalance(const ContactBodies& bodies, const Matrix& force, const Vector& energy, const Vector& largest);

/// Norm of the residual of the body that has the largest beside its own energy.
/// \param own    product r.M r of each part
/// \param least  lower bound of the energy of each part that counts, twice
double bodyResidual(const Vector& own, const Vector& energy, const Vector& largest, const Vector& least);
/// Products r.M r, summed by part. Collective.
Vector productsByPart(const ContactSets& sets, const Preconditioner& preconditioner, const MultiVector& r);

}  // namespace suture
