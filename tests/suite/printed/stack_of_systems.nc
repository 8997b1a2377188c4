; run: exit 0
; page 1037259147 stack of coordinate systems (#CS ADD)
; end X1 Y2
N10 #CS ADD [ICS] [10,10,0,0,0,45]
N20 #CS ADD [WCS] [15,20,0,0,0,0]
N30 #CS ADD [PCS] [10,15,0,0,0,5]
N40 G00 X1 Y2
N50 M30
