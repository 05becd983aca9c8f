//! Sines, logarithms and their like, with the same bits on every machine: those of a C library differ between libraries, their
//! versions and the processors that they choose their code by.

pub use libm::{
    asinf as asin, atan2f as atan2, atanf as atan, cosf as cos, exp as exp_f64, expf as exp, hypotf as hypot,
    log as ln_f64, logf as ln, powf, sincosf as sin_cos, sinf as sin, tanf as tan,
};
