/// What can go wrong between the program and the GPU.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// No adapter at all.
    #[error("no GPU found (a software one such as lavapipe is enough): {0}")]
    NoAdapter(String),
    /// No adapter of the name asked for.
    #[error("no GPU is called \"{wanted}\"; there are: {found}")]
    NoSuchAdapter {
        /// As asked for.
        wanted: String,
        /// Names of all adapters, separated by commas.
        found: String,
    },
    /// The adapter refused a device.
    #[error("the GPU {adapter} gives no device: {source}")]
    NoDevice {
        /// Its name.
        adapter: String,
        /// What the adapter said.
        source: wgpu::RequestDeviceError,
    },
    /// The device went away; everything on it is gone.
    #[error("the GPU was lost: {0}")]
    DeviceLost(String),
    /// A shader did not compile; each line names file and line.
    #[error("shader program {program}: {messages}")]
    Shader {
        /// Name in the table.
        program: &'static str,
        /// `file:line: text`, one per line.
        messages: String,
    },
    /// wgpu refused something; names the pass.
    #[error("{pass}: {message}")]
    Refused {
        /// Which pass or resource.
        pass: &'static str,
        /// As wgpu says it.
        message: String,
    },
    /// The volume does not fit, even reduced.
    #[error("the volume does not fit on this GPU ({0})")]
    TooLarge(String),
    /// Nothing to draw yet.
    #[error("no subject has been uploaded")]
    NoSubject,
    /// A picture of no pixels or too many was asked for.
    #[error("a picture of {width} × {height} pixels cannot be drawn here (each side 1 to {max})")]
    BadSize {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Largest side.
        max: u32,
    },
    /// The PNG encoder failed.
    #[error("PNG: {0}")]
    Png(#[from] png::EncodingError),
}
