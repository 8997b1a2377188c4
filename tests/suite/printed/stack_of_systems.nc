; check: exit 1
; page 1037259147 linked coordinate systems (#CS ADD)
; error K-0019 at 6:5
; error K-0019 at 7:5
; error K-0019 at 8:5
N10 #CS ADD [ICS] [10,10,0,0,0,45]
N20 #CS ADD [WCS] [15,20,0,0,0,0]
N30 #CS ADD [PCS] [10,15,0,0,0,5]
N40 M30
