#pragma once

namespace suture {

// Products of small dense matrices, stored by columns, compiled for each processor generation. Local.

/// result = matrix x. \param rows, columns  of the matrix, without gaps between its columns
void combineColumns(int rows, int columns, const double* matrix, const double* x, double* result);

/// result = a b. \param rows, inner  of a \param columns  of b; the strides separate columns
void multiplySmall(int rows, int inner, int columns, const double* a, int strideA, const double* b, int strideB, double* result,
                   int strideResult);

}  // namespace suture
