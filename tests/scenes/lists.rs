//! The list of everything: every row that it offers does something, in every scene, from every pane.

use hopfscope::scene::library;
use hopfscope::session::{ListKind, Msg, Overlay, Pane, Session, Size, settle, update};

use super::computed;

/// The session after the keys, which are characters.
fn pressed(mut session: Session, keys: &str) -> Session {
    for key in keys.split(' ') {
        update(&mut session, Msg::Key(key.parse().unwrap()));
    }
    session
}

/// The rows that are refused though the list offers them, each with what is said.
fn refused(session: &Session) -> Vec<String> {
    let opened = pressed(session.clone(), "? ?");
    let Some(Overlay::List(ListKind::Palette, list)) = &opened.overlay else { panic!("a list") };
    let rows = opened.palette_rows(list);
    assert!(rows.len() > 150, "{} rows", rows.len());
    let offered = rows.iter().enumerate().filter(|(_, row)| opened.refused(list, **row).is_none());
    let told = offered.filter_map(|(place, row)| {
        let mut session = opened.clone();
        if let Some(Overlay::List(_, list)) = &mut session.overlay {
            list.selected = place;
        }
        let after = pressed(session, "<enter>");
        let notice = after.notice.filter(|notice| notice.error && after.waiting.is_none())?;
        Some(format!("{} {:?}: {}", session_name(&opened), row.name(), notice.text))
    });
    told.collect()
}

fn session_name(session: &Session) -> String {
    format!("{} {:?}", session.scene.name, session.focus)
}

#[test]
fn every_row_of_the_list_does_something_where_it_is_offered() {
    let mut wrong = Vec::new();
    for (index, scene) in library().iter().enumerate() {
        let mut session = Session::new(scene.clone(), Size { width: 120, height: 40 });
        settle(&mut session, |_, request| Some(computed(request)));
        // The parameters have their turn, and the first and the last plot.
        let plot = if index % 2 == 0 { 0 } else { session.plots.len() - 1 };
        let focus = if index % 3 == 0 {
            Pane::Parameters
        } else {
            Pane::Plot(plot)
        };
        wrong.extend(refused(&Session { focus, plot, ..session }));
    }
    assert!(wrong.is_empty(), "{} rows are refused:\n{}", wrong.len(), wrong.join("\n"));
}
