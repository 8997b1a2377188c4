; check: exit 1
; page 1048407819 change of a coordinate system (#CS SET)
; error K-0019 at 5:5
; error K-0019 at 6:5
N10 #CS ADD [ICS] [10,10,0,0,0,45]
N80 #CS SET [ICS] [20,10,0,0,0,10]
M30
