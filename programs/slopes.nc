; One move under each slope. The slope is that of the program start, P-CHAN-00071: 0 STEP, 1 TRAPEZ, 2 SIN2, 3 HSC; the
; program runs once with each under --vary channel.prog_start.slope.profile=0..3.
; v = 150 mm/s, a = 3500 mm/s2, ramps t = 30 ms.
;   N20        one block of 20 mm from rest to rest: L/v + v/a = 0.1762 s with STEP, L/v + v/a + t = 0.2062 s with the
;              others; the jerk is a/t = 117 m/s3 with TRAPEZ and HSC, pi/2 times as much at the peaks of SIN2
;   N40, N50   the same distance back in two blocks, the first of 1 mm at a lower feed: too short to reach it, so the path
;              accelerates across the block boundary and takes as long as one block
%SLOPES
N10 G71 G90 G00 X0
N20 G01 X20 F9000
N30 G04 0.1
N40 G01 X19 F6000
N50 X0 F9000
N60 G04 0.1
N70 M30
