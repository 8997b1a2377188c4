; check: exit 1
; page 1037628043 chain of coordinate systems (#CS SELECT)
; error K-0019 at 7:5
; error K-0019 at 8:5
; error K-0019 at 9:5
; error K-0019 at 10:5
N10 #CS ADD [ICS] [10,10,0,0,0,45]
N20 #CS ADD [WCS] [15,20,0,0,0,0]
N30 #CS ADD [PCS] [10,15,0,0,0,5]
N60 #CS SELECT [WCS]
M30
