/// What can go wrong between the program and the GPU.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The machine has no GPU that can be used, not even in software.
    #[error("no GPU found (a software one such as lavapipe is enough): {0}")]
    NoAdapter(String),
    /// No adapter of the name asked for.
    #[error("no GPU is called \"{wanted}\"; there are: {found}")]
    NoSuchAdapter {
        /// The name that was asked for.
        wanted: String,
        /// Names of all adapters, separated by commas.
        found: String,
    },
    /// The adapter refused a device.
    #[error("the GPU {adapter} gives no device: {source}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// The error of the adapter.
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
        /// The message of wgpu.
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
        /// Width that was asked for, pixels.
        width: u32,
        /// Height that was asked for, pixels.
        height: u32,
        /// The longest side that this device draws, pixels.
        max: u32,
    },
    /// Whoever asked for the picture stopped it.
    #[error("the picture was stopped")]
    Stopped,
    /// The PNG encoder failed.
    #[error("PNG: {0}")]
    Png(#[from] png::EncodingError),
    /// Bytes are no PNG file, or a broken one.
    #[error("PNG: {0}")]
    NotPng(#[from] png::DecodingError),
}
