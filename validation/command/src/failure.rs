//! A command that failed.

/// A command that failed: its message and the exit status.
#[derive(Debug)]
pub struct Failure {
    /// One message for people, on standard error.
    pub message: String,
    /// 1 for a failed gate, 2 for bad usage or input.
    pub status: u8,
}

impl Failure {
    /// Bad usage or bad input: exit status 2.
    pub fn input(message: impl std::fmt::Display) -> Self {
        Self { message: message.to_string(), status: 2 }
    }

    /// A gate that failed: exit status 1.
    pub fn gate(message: impl std::fmt::Display) -> Self {
        Self { message: message.to_string(), status: 1 }
    }
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        let mut message = String::new();
        for source in error.into().chain().map(ToString::to_string) {
            if message.is_empty() {
                message = source;
            } else if !message.contains(&source) {
                message = format!("{message}: {source}");
            }
        }
        Self::input(message)
    }
}

/// Refuses input with a message.
macro_rules! bail {
    ($($message:tt)+) => {
        return Err($crate::failure::Failure::input(format!($($message)+)))
    };
}

/// Refuses input, with a message, unless it is as it has to be.
macro_rules! ensure {
    ($holds:expr, $($message:tt)+) => {
        if !$holds {
            $crate::failure::bail!($($message)+);
        }
    };
}

pub(crate) use {bail, ensure};

/// Adds the file or the flag to a refusal.
pub trait AtPlace<T> {
    /// Puts the file or the flag before the message.
    ///
    /// # Errors
    /// [`Failure`] if there was one.
    fn at(self, place: impl std::fmt::Display) -> Result<T, Failure>;
}

impl<T, E: Into<Failure>> AtPlace<T> for Result<T, E> {
    fn at(self, place: impl std::fmt::Display) -> Result<T, Failure> {
        self.map_err(|error| {
            let Failure { message, status } = error.into();
            Failure { message: format!("{place}: {message}"), status }
        })
    }
}
