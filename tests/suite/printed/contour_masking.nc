; check: exit 1
; page 206480651 masking of contours (G141)
; error K-0019 at 4:5
N10 G141
N20 G140
N30 M30
