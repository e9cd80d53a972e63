#pragma once

#include <Eigen/Dense>

// Decompositions of matrices of any size take seconds to compile. Precompiled headers include this
// file, so that compiled_decompositions.cpp does it for all. Others, which are compiled at -O3
// where they are called, would give other last digits from there.

extern template class Eigen::PartialPivLU<Eigen::MatrixXd>;
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::PartialPivLU<Eigen::Matrix3d>;
extern template class Eigen::PartialPivLU<Eigen::Matrix<double, 6, 6>>;
extern template class Eigen::FullPivLU<Eigen::Matrix3d>;
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&,
                                                        int);
extern template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, bool);
