//! Sparse LU factorization and Krylov-Schur iteration over faer.
