//! The boundary to a page: bytes go in and out by two buffers.
//!
//! The page calls `room`, writes its question there, calls `answer`, and reads
//! the answer from `answer_start`.
#![expect(
    unsafe_code,
    reason = "a name that a page calls must not be mangled; no pointer is followed here"
)]

use std::cell::RefCell;

thread_local! {
    static QUESTION: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a question of `length` bytes.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    QUESTION.with_borrow_mut(|question| {
        *question = vec![0; length];
        question.as_mut_ptr()
    })
}

/// Answers the question, and gives the length of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    let question = QUESTION.take();
    let found = crate::answer(&String::from_utf8_lossy(&question));
    ANSWER.with_borrow_mut(|answer| {
        *answer = found.into_bytes();
        answer.len()
    })
}

/// Address of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer_start() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}
