//! The mass on its belt (Fig. 1), where the motion has it at the moment that is played; above it where it came from, and
//! below it the forces that say why it holds or lets go.
//!
//! Along the horizontal axis everything is in the units of the motion: the mass is at its displacement from static
//! equilibrium, forces are the displacements at which the spring would balance them, the marks of the belt move with its
//! speed. Heights count rows of the screen, so that the mass is as high as wide whatever the shape of the plot. Where there
//! is little room the trail goes first, then the forces; the mass, its spring and the belt always stand.

use super::{Dash, LineStyle, Picture, Role, Ticks};
use crate::flow::Sample;
use crate::numerics::{powi, real};
use crate::scene::{Layer, Point, Span, Window, rectangle};
use crate::session::{Framing, Session};
use crate::words::Notation;

/// Columns and rows of a plot, a row being twice as high as a column is wide.
pub type Room = [f64; 2];

/// Width of the mass, as a fraction of the window.
const WIDTH: f64 = 0.16;

/// Rows that the belt takes.
const BELT: f64 = 1.0;

/// Rows that the forces take, each one of them.
const FORCES: f64 = 3.0;

/// Rows of the trail: with fewer it tells nothing, and more are not needed.
const TRAIL: (f64, f64) = (3.0, 12.0);

/// Dimensionless time that the trail goes back: a period and a half.
const AGO: f64 = 1.5 * std::f64::consts::TAU;

/// Points of the trail in a row of the screen.
const POINTS: f64 = 6.0;

/// Heights of the axes of spring and damper above the belt, and half the heights of both, in heights of the mass.
const SPRING: f64 = 0.75;
const DAMPER: f64 = 0.3;
const HALF: f64 = 0.14;

const COILS: u32 = 9;

/// Ends of the cylinder of the damper, and its piston at rest, as fractions of the way from the wall to the
/// mass at rest.
const CYLINDER: (f64, f64) = (0.15, 0.75);
const PISTON: f64 = 0.45;

/// Marks on each surface of the belt.
const MARKS: u16 = 8;

/// How much faster than the mass a belt is drawn whose speed is not known: the oscillator of the paper has none, but the
/// belt behind it always overtakes the mass.
const FASTER: f64 = 1.25;

/// What a part of the sketch is drawn with: where things stand across and upwards.
struct Sketch {
    across: Span,
    /// Height of the upper surface of the belt.
    top: f64,
    /// Width of the mass, along the horizontal axis.
    width: f64,
    /// Height of the mass, in rows.
    height: f64,
}

pub fn draw(picture: &mut Picture, session: &Session, index: usize, [columns, rows]: Room) {
    picture.axes("q", "");
    // Heights without meaning have no scale.
    picture.upward = Some(Ticks::default());
    // Before the motion is played, its start.
    let moment = session.head().or_else(|| session.trajectory()?.at(0.0));
    if session.plots[index].framing != Framing::User {
        picture.window.x = in_sight(picture.window.x, session, moment);
    }
    let across = picture.window.x;
    let height = (0.5 * WIDTH * columns).round().min(rows - BELT).max(1.0);
    let free = rows - BELT - height;
    let forces = if free >= FORCES { FORCES } else { 0.0 };
    let trail = Some(free - forces).filter(|left| *left >= TRAIL.0).map(|left| left.min(TRAIL.1));
    // What is left over stands above and below in equal parts.
    let below = (0.5 * (free - forces - trail.unwrap_or(0.0)).max(0.0)).floor();
    picture.window.y = Span::new(-below, rows.max(1.0) - below).unwrap_or_default();
    let width = 2.0 * height * across.width() / columns.max(1.0);
    let sketch = Sketch { across, top: forces + BELT, width, height };
    if let Some(cursor) = &mut picture.cursor {
        cursor.y = sketch.top + 0.5 * height;
    }
    // The cursor points to a position only.
    let pointed = picture.cursor.map(|Point { x: q, .. }| Sample { tau: 0.0, q, v: 0.0 });
    picture.reading = pointed.or(moment).map(|moment| reading(session, &moment));
    let Some(moment) = moment.filter(|_| session.layers.contains(&Layer::Mass)) else { return };
    if forces > 0.0 {
        bars(picture, session, &moment, columns);
    }
    sketch.machine(picture, session, &moment);
    if let Some(rows) = trail {
        sketch.trail(picture, session, &moment, rows);
    }
}

/// This range, doubled until the mass stays in it as far as it has swung: a mass that is lost is what one wants to see.
fn in_sight(across: Span, session: &Session, moment: Option<Sample>) -> Span {
    let last = moment.map_or(0.0, |moment| moment.tau);
    let samples = session.trajectory().into_iter().flat_map(|motion| &motion.samples);
    let swung = samples.take_while(|sample| sample.tau <= last).copied().chain(moment);
    let half = 0.5 * WIDTH * across.width();
    let ends = [across.from() + half, across.to() - half];
    let parts = swung.flat_map(|sample| ends.map(|end| sample.q / end));
    let least = parts.fold(0.0, f64::max);
    let wider = (0..1000).map(|power| powi(2.0, power)).find(|times| *times >= least);
    across.scaled(0.0, wider.unwrap_or(1.0))
}

/// The moment in numbers, physical ones where the scene is of a machine.
fn reading(session: &Session, moment: &Sample) -> String {
    let Sample { tau, q, v } = *moment;
    let notation = Notation(session.running().map(|running| running.reduced.units));
    let (time, place) = (notation.name("tau", "t"), notation.name("q", "x"));
    let (tau, q, v) = (notation.time(tau, 3), notation.length(q, 3), notation.velocity(v, 3));
    format!("{time} {tau}  {place} {q}  v {v}")
}

/// The forces on the mass as bars, from above, and the limits of dry friction: where the spring at rest reaches beyond
/// them, the mass lets go.
fn bars(picture: &mut Picture, session: &Session, moment: &Sample, columns: f64) {
    /// Columns of a name and its blanks.
    const NAME: f64 = 10.0;
    let Some(forces) = session.forces(moment) else { return };
    for end in [-forces.limit, forces.limit] {
        picture.curve("limit of friction", [[end, 0.0], [end, FORCES]]);
    }
    let of_machine = session.draws_whole();
    let damping = if of_machine { "belt" } else { "damper" };
    let all = [
        ("friction", "friction on the mass", Some(forces.friction)),
        (damping, "damping on the mass", forces.damping),
        ("spring", "spring on the mass", Some(forces.spring)),
    ];
    let [left, right] = picture.window.x.ends();
    let named = left + NAME * picture.window.x.width() / columns.max(1.0);
    for (row, (name, line, force)) in (0_u8..).zip(all) {
        let y = f64::from(row) + 0.5;
        let line = LineStyle::from(line);
        // Where the bar reaches the name, that stands at the other end of its row.
        let hidden = force.is_some_and(|force| force < named);
        picture.caption([if hidden { right } else { left }, y], name, line.role);
        if let Some(force) = force {
            picture.curve(line, [[0.0, y], [force, y]]);
        }
    }
}

impl Sketch {
    fn machine(&self, picture: &mut Picture, session: &Session, moment: &Sample) {
        let Sketch { across, top, width, height } = *self;
        let wall = across.from();
        self.belt(picture, speed(session, picture.window) * moment.tau);
        let (left, right) = (moment.q - 0.5 * width, moment.q + 0.5 * width);
        let r = session.problem.parameters.r;
        let middle = top - 0.5 * BELT;
        picture.curve("where the mass may rest", [[-r, middle], [r, middle]]);
        picture.curve("spring", self.spring(wall, left));
        for piece in self.damper(wall, -0.5 * width, left) {
            picture.curve("damper", piece);
        }
        picture.curve("mass", rectangle([left, right], [top, top + height]));
        // A small mass has no room for its letter.
        if height >= 3.0 {
            picture.caption([moment.q, top + 0.5 * height], "m", Role::Trajectory);
        }
        if session.sticks(moment) {
            // Within the row of the mass, of which it is the lower side.
            let foot = top + 0.1;
            picture.curve("sticks", [[left, foot], [right, foot]]);
        }
    }

    /// The belt, its marks moved by `way` to the right above and to the left below.
    fn belt(&self, picture: &mut Picture, way: f64) {
        let Sketch { across, top, .. } = *self;
        // Both surfaces are seen within the rows of the belt.
        let low = top - 0.76 * BELT;
        for y in [low, top] {
            picture.curve("belt", [[across.from(), y], [across.to(), y]]);
        }
        let gap = across.width() / f64::from(MARKS);
        let tick = 0.3 * BELT;
        for (way, from, to) in [(way, top, top - tick), (-way, low, low + tick)] {
            let first = across.from() + way.rem_euclid(gap);
            for number in 0..MARKS {
                let x = first + f64::from(number) * gap;
                picture.curve("mark of the belt", [[x, from], [x, to]]);
            }
        }
    }

    /// Where the mass was, from its top upwards: the higher the longer ago, in three pieces that fade.
    fn trail(&self, picture: &mut Picture, session: &Session, moment: &Sample, rows: f64) {
        const FADING: [Dash; 3] = [Dash::Solid, Dash::Dashed, Dash::Dotted];
        let Some(motion) = session.trajectory() else { return };
        let foot = self.top + self.height;
        let step = AGO / (POINTS * rows);
        let place = |back: f64| {
            let at = motion.at(moment.tau - back).filter(|_| back <= moment.tau)?;
            Some([at.q, foot + rows * back / AGO])
        };
        for (age, dash) in FADING.into_iter().enumerate() {
            let from = real(age) * AGO / 3.0;
            let backs = (0..).map(|number: u16| from + f64::from(number) * step);
            let backs = backs.take_while(|back| *back <= from + AGO / 3.0 + 0.5 * step);
            let line = LineStyle { dash, ..LineStyle::from("trail of the mass") };
            picture.curve(line, backs.map_while(place));
        }
    }

    /// The zigzag of a spring between two places.
    fn spring(&self, from: f64, to: f64) -> Vec<Point> {
        let coils = f64::from(COILS);
        let (axis, half) = (self.top + SPRING * self.height, HALF * self.height);
        let at = |part: f64, y: f64| Point { x: from + part * (to - from), y };
        let teeth = (0..COILS).map(|tooth| {
            let side = if tooth % 2 == 0 { half } else { -half };
            at((f64::from(tooth) + 1.0) / (coils + 1.0), axis + side)
        });
        std::iter::once(at(0.0, axis)).chain(teeth).chain([at(1.0, axis)]).collect()
    }

    /// The cylinder of a damper at the wall, and the rod with its piston at the mass, whose left side is at
    /// `mass` and without motion at `rest`.
    fn damper(&self, wall: f64, rest: f64, mass: f64) -> [Vec<Point>; 3] {
        let (axis, half) = (self.top + DAMPER * self.height, HALF * self.height);
        let at = |x: f64, y: f64| Point { x, y: axis + y };
        // A window that begins beyond the mass shows no wall.
        let gap = (rest - wall).max(0.0);
        let (start, end) = (wall + CYLINDER.0 * gap, wall + CYLINDER.1 * gap);
        let piston = (wall + PISTON * gap + mass - rest).clamp(start, end);
        [
            vec![at(wall, 0.0), at(start, 0.0)],
            vec![at(end, half), at(start, half), at(start, -half), at(end, -half)],
            vec![at(piston, 0.8 * half), at(piston, -0.8 * half), at(piston, 0.0), at(mass, 0.0)],
        ]
    }
}

/// The speed of the belt; without a machine somewhat more than the mass ever has where it is seen.
fn speed(session: &Session, window: Window) -> f64 {
    if let Some(running) = session.running() {
        return running.reduced.sticking_velocity;
    }
    let samples = session.trajectory().into_iter().flat_map(|motion| &motion.samples);
    let seen = samples.filter(|sample| window.x.contains(sample.q));
    let fastest = seen.map(|sample| sample.v.abs()).fold(0.0, f64::max);
    FASTER
        * if fastest > 0.0 {
            fastest
        } else {
            session.problem.parameters.r
        }
}
