%lag
(lesson 6: out without, back with feedforward)
N10 G01 X100 F6000
N20 G04 0.3
N30 G135
N40 X0
N50 M30
