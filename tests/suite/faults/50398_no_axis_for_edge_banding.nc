; check --set channel.m_synch[97]=MNE_SNS: exit 1
; error 50398 at 4:5
N10 G108
N20 M97 G01 X10 F100
N30 M30
