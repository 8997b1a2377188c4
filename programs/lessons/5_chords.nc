%chords
(lesson 5: a circle of radius 10 mm made of chords of V.E.STEP degrees)
N10 #SLOPE [TYPE=HSC]
N20 P1=0 P2=V.E.STEP
N30 G00 X10
N40 $WHILE P1<360
N50 P1=P1+P2
N60 G01 X[10*COS[P1]] Y[10*SIN[P1]] F6000
N70 $ENDWHILE
N80 M30
