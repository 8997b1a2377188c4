; 100 mm at F6000 under real-time inputs (feedhold_and_override.csv): half the feed from 0.4 s on, held from 0.8 s to
; 1.2 s, 120 % from 1.6 s on. Without --input the path takes 1.03 s.
%FEEDHOLD_AND_OVERRIDE
N10 #SLOPE [TYPE=STEP]
N20 G90 G01 X100 F6000
N30 M30
