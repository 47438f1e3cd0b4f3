//! Eyes, teeth and what covers them; and the poses that open and close them.

use geometry::bound::Options;
use geometry::cubic::signed_area;
use geometry::local::Part;
use geometry::opening::Opening;
use geometry::point::Point;
use geometry::pose::{Channel, Pose};
use geometry::scene::Layer;

use crate::scenes::{blob, blobs, face, pose_of, rig_of, warped};

#[test]
fn zero_pose_is_rest_bit_for_bit() {
    let rig = rig_of(face(12.0), &blobs(Layer::Fore), Options::default());
    let (vertices, limit) = rig.vertices(&Pose::default());
    assert_eq!(vertices, rig.rest_vertices());
    assert_eq!(limit.scale, 1.0);
    assert!(warped(&rig, &vertices).is_empty());
}

#[test]
fn upper_teeth_stay_and_lower_teeth_drop_unstretched() {
    let landmarks = face(0.0);
    let teeth = blob(landmarks[62] + Point::new(0.0, 3.0), Point::new(14.0, 4.0));
    let paths = [(Layer::Local(Part::MouthUpper), teeth.clone()), (Layer::Local(Part::MouthLower), teeth.clone())];
    let rig = rig_of(landmarks, &paths, Options::default());
    let moved = warped(&rig, &pose_of(&rig, &[(Channel::Jaw, 1.0), (Channel::Smile, 0.5)]));
    assert_eq!(moved.keys().copied().collect::<Vec<_>>(), [1]);
    assert!((signed_area(&moved[&1]) / signed_area(&teeth) - 1.0).abs() < 1e-9);
    assert!(moved[&1][0].y - teeth[0].y > 10.0);
}

/// Closed form: the middle pair of inner lips meets, and the jaw then opens as far as that of a mouth at rest closed.
#[test]
fn neutral_closes_a_mouth_that_rests_open() {
    let rig = rig_of(face(14.0), &blobs(Layer::Fore), Options::default());
    let rest = pose_of(&rig, &[]);
    assert!(rest[66].y - rest[62].y > 10.0, "the source's mouth is open");
    let neutral = pose_of(&rig, &[(Channel::Neutral, 1.0)]);
    assert!((neutral[66].y - neutral[62].y).abs() < 1e-9);
    assert_eq!(neutral[60], rest[60], "corners stay");
    let spoken = pose_of(&rig, &[(Channel::Neutral, 1.0), (Channel::Jaw, 0.2)]);
    let opened = pose_of(&rig, &[(Channel::Jaw, 0.2)]);
    assert!(spoken[66].y < opened[66].y, "a track opens the mouth from closed, not from its rest");
}

#[test]
fn iris_keeps_its_shape_and_full_blink_closes_exactly() {
    let landmarks = face(0.0);
    let centre = landmarks[37].lerp(landmarks[40], 0.5);
    let paths = [(Layer::Local(Part::LeftIris), blob(centre, Point::new(6.0, 6.0)))];
    let rig = rig_of(landmarks, &paths, Options::default());
    for pose in
        [vec![(Channel::GazeX, 1.0), (Channel::GazeY, 0.5)], vec![(Channel::Yaw, 15.0)], vec![(Channel::Roll, 15.0)]]
    {
        let iris = &warped(&rig, &pose_of(&rig, &pose))[&0];
        let (across, along) = (iris[0].distance(iris[6]), iris[3].distance(iris[9]));
        assert!((across / along - 1.0).abs() < 1e-9, "a circle stays a circle");
    }
    let blink = pose_of(&rig, &[(Channel::BlinkLeft, 1.0), (Channel::BlinkRight, 1.0)]);
    assert!(warped(&rig, &blink).is_empty(), "the eyeball is not squeezed");
    for outline in &rig.openings(&blink)[..2] {
        assert!(signed_area(outline).abs() < 1e-9);
    }
}

#[test]
fn lids_stay_in_their_socket_and_lashes_close_over_them() {
    let landmarks = face(0.0);
    let eye = landmarks[37].lerp(landmarks[40], 0.5);
    let paths =
        [(Layer::Fore, blob(eye, Point::new(3.0, 2.0))), (Layer::Fore, blob(landmarks[37], Point::new(3.0, 2.0)))];
    let rig = rig_of(landmarks, &paths, Options::default());
    let moved = warped(&rig, &pose_of(&rig, &[(Channel::BlinkLeft, 1.0)]));
    assert_eq!(moved.keys().copied().collect::<Vec<_>>(), [1]);
}

#[test]
fn skin_around_an_eye_with_a_lid_of_its_own_rests() {
    let landmarks = face(0.0);
    let outline = Opening::LeftEye.outline(&landmarks);
    let middle = landmarks[36].lerp(landmarks[39], 0.5);
    let below = blob(landmarks[41] + Point::new(0.0, 5.0), Point::new(6.0, 2.0)); // no brow moves it
    let moved = |lid_size: f64| {
        let lid: Vec<Point> = outline.iter().map(|&p| middle.lerp(p, lid_size)).collect();
        let rig = rig_of(landmarks, &[(Layer::Fore, below.clone()), (Layer::Fore, lid)], Options::default());
        warped(&rig, &pose_of(&rig, &[(Channel::BlinkLeft, 1.0)])).into_keys().collect::<Vec<_>>()
    };
    assert_eq!(moved(0.5), [0], "a shred of skin is no lid");
    assert!(moved(0.92).is_empty());
}

/// Lids that close aslant, under low brows, carry their bands across those of the brows.
#[test]
fn slanting_eyes_under_low_brows_close_fully() {
    let mut landmarks = face(0.0);
    for brow in &mut landmarks[17..27] {
        brow.y += 9.0;
    }
    for (upper, shift) in [(37, 0.0), (38, -7.0), (43, 7.0), (44, 0.0)] {
        landmarks[upper].x += shift;
    }
    let rig = rig_of(landmarks, &[], Options::default());
    let (vertices, limit) = rig.vertices(&Pose::of(&[(Channel::BlinkLeft, 1.0), (Channel::BlinkRight, 1.0)]));
    assert_eq!(limit.scale, 1.0);
    for outline in &rig.openings(&vertices)[..2] {
        assert!(signed_area(outline).abs() < 1e-9);
    }
}

/// Lids of large drawn eyes reach down to the cheeks, which go with the mouth.
#[test]
fn mouth_below_large_eyes_rounds_fully() {
    let mut landmarks = face(0.0);
    let cheek = landmarks[2].lerp(landmarks[31], 0.5);
    for (lower, upper) in [(41, 37), (40, 38)] {
        // Where the band below the lid, three tenths of the eye's height from it, comes to lie a pixel from the cheek.
        let depth = (cheek.y - 2.0 - landmarks[upper].y) / 1.3;
        landmarks[lower] = Point::new(cheek.x + 1.0 + if lower == 40 { 15.0 } else { 0.0 }, landmarks[upper].y + depth);
        landmarks[upper].x = landmarks[lower].x;
    }
    let rig = rig_of(landmarks, &[], Options::default());
    let (_, limit) = rig.vertices(&Pose::of(&[(Channel::Jaw, 0.3), (Channel::Round, 1.0)]));
    assert_eq!(limit.scale, 1.0);
}
