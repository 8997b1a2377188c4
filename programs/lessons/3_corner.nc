%corner
(lesson 3: a sharp corner of 90 degrees)
N10 #SLOPE [TYPE=HSC]
N20 G01 X20 F6000
N30 Y20
N40 M30
