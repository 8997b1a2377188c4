; run --set channel.multi_dimension_in_block=1: exit 0
; page 15556693643 dimensions for single words (G90, G91)
; passes X30 Y20 Z0
; passes X30 Y50 Z20
; passes X30 Y80 Z50
; end X40 Y80 Z30
N05 F6000
N10 X10 Y10
N20 G91 X20 G90 Y20
N30 X30 G91 Y30 Z20
N30 G90 X30 G91 Y30 G90 Z20
N100 G90 G91 Z30
N110 G91 X10 G90 Z30
M30
