; check --set channel.kasto_multi_block=1: exit 1
; page 206224907 edge banding over several blocks (G107)
; error K-0019 at 5:5
N10 X0 Y0
N20 G108
N30 G01 X90 Y90 F20
N40 M97 G01 X100 Y100 F8
N50 X110 Y110
N60 G107
N70 G00 X200 Y200
N80 M30
