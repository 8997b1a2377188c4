; run --set channel.m_synch[26]=MVS_SLM --set channel.m_prozess_zeit[26]=800000 --techno-times: exit 0
; warning K-0111 at 4:1
(once for each function)
M26 G00 X25
G01 F6000 X60
M26
M30
