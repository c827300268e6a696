//! House rules that the compiler doesn't enforce.
