; run --set channel.m_synch[1]=0x2 --set channel.m_prozess_zeit[1]=800000 --techno-times: exit 0
; page 15319587595 M and H functions, example 3: M1 takes 0.8 s
; end X100
G01 F6000
N10 M1 X100
M30
