%one_move
(lesson 1: 100 mm at F6000)
N10 G01 X100 F6000
N20 M30
