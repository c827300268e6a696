//! Unpacks what `reports/lab.html` carries: LZMA makes the engine a third
//! smaller than the gzip that a browser knows.

#![deny(missing_docs)]

mod abi;

mod question;
