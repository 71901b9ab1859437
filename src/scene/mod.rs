//! What is on show: a scene, the layers it is drawn in, the requests they need answered, and their
//! answers.

pub mod answer;
pub mod file;
pub mod layer;
pub mod library;
pub mod machine;
pub mod misread;
pub mod ordinate;
pub mod recording;
pub mod request;
pub mod said;
#[expect(clippy::module_inception, reason = "the scene itself, beside what belongs to it")]
pub mod scene;
pub mod speeds;
pub mod usual;
pub mod views;
pub mod whole;
pub mod window;
pub mod zones;

pub use answer::{Answer, Answered};
pub use layer::{LAYERS, Layer, LayerSpec, letters};
pub use library::{NoScene, find, library, plain};
pub use machine::{Machine, Rig, Running};
pub use misread::Misread;
pub use ordinate::{ABSCISSAE, Height, ORDINATES, Ordinate, Unit};
pub use recording::{Fit, Fitted, Recording};
pub use request::{Request, TOPICS, Topic};
pub use scene::{Scene, Variant};
pub use views::{ARRANGEMENTS, Arrangement, Axes, Exhibit, MOST_PLOTS, VIEWS, View, ViewSpec};
pub use window::{Point, Span, Window};
