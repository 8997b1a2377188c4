%slopes
(lesson 2: the slope is chosen with --vary)
N10 G01 X20 F6000
N20 M30
