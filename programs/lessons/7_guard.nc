%guard
(lesson 7: a square of 20 mm through the Vibration Guard at V.E.HZ)
N10 #VIB GUARD ON [MODE=1 FREQ=V.E.HZ]
N20 G01 X20 F6000
N30 Y20
N40 X0
N50 Y0
N60 M30
