"""Pictures of a motion: first what is drawn, as numbers and labels, then who draws it.

`series`, `path`, `drift`, `error`, `portrait`, `potential` and `section` each make a `Picture`
(`drawing`) of a problem; `figure` writes it with Matplotlib, `terminal` in characters.  `scene`
makes the frames of an animation; `page` writes them as HTML and `film` as GIF or MP4.

No motion is integrated here: `run` asks `lagcli.numerics` for it.  Matplotlib is imported by
`figure` and `film` alone.
"""
