//! The path `own`: legs from a file.

use super::{Answer, DriveOptions};
use crate::outcome::Failure;
use alluvium::Real;
use alluvium::case::OwnPath;
use alluvium::driver::Driver;
use alluvium::material::Material;

/// Along the legs: how many are gone, and what the law answered.
pub fn follow<T: Real, M: Material<T>>(
    mut driver: Driver<T, M>,
    options: &DriveOptions,
) -> Result<Answer, Failure> {
    let path = read::<T>(options)?;
    let (mut gone, mut rows) = (vec![0.0], vec![driver.row()]);
    for cycle in 1..=path.cycles {
        for (k, own) in path.legs.iter().enumerate() {
            let increments = own.increments.unwrap_or(options.way.steps as usize);
            let followed = driver.follow(&own.leg, increments);
            let stopped = |error| Failure::Numerical(format!("cycle {cycle}, leg {}, {error}", k + 1));
            rows.extend(followed.map_err(stopped)?);
            let before = ((cycle - 1) * path.legs.len() + k) as f64;
            gone.extend((1..=increments).map(|n| before + n as f64 / increments as f64));
        }
    }
    Ok(Answer::of(gone, &rows))
}

fn read<T: Real>(options: &DriveOptions) -> Result<OwnPath<T>, Failure> {
    let way = &options.way;
    let given = [
        ("--strain", way.strain.is_some()),
        ("--angle", way.angle.is_some()),
        ("--cycles", way.cycles.is_some()),
    ];
    if let Some((flag, _)) = given.iter().find(|(_, given)| *given) {
        return Err(Failure::Usage(format!("{flag} has no meaning on the path own: its file says it")));
    }
    let Some(file) = &way.legs else {
        return Err(Failure::Usage("the path own needs its legs: give --legs FILE".to_owned()));
    };
    let name = file.display().to_string();
    let text = std::fs::read_to_string(file)
        .map_err(|error| Failure::Usage(format!("cannot read {name}: {error}")))?;
    Ok(OwnPath::parse(&name, &text)?)
}
