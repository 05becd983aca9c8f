#!/usr/bin/env python3
"""Prints the shares of broadcast frames that arrive in ns-3, with which src/comms/radio/air/tests.rs compares. Python 3.11, some minutes:

    python3 -m venv /tmp/ns3 && /tmp/ns3/bin/pip install -r tests/airtime/requirements.txt
    /tmp/ns3/bin/python tests/airtime/ns3_values.py > tests/airtime/ns3_values.csv

Stations of an 802.11 ad hoc network say things to all, each at random moments, on one channel. All hear each other. `equal`: everybody
is heard equally loud, so that none of two frames that overlap can be read. `pitch`: the stations stand on 9 m x 6 m and a frame that is
much louder than the other one can.
"""

import random

from ns import ns

SECONDS = 20.0
BYTES = 200
STATIONS = [4, 8, 12, 16, 22]
LOADS = [0.1, 0.3, 0.5, 0.7, 0.9, 1.2, 1.5]
# IP and UDP around a datagram: packet sockets leave them out.
IP_AND_UDP = 28
# Airtime::frame of a datagram of BYTES at 1 Mbit/s, s.
FRAME = 192e-6 + 8 * (BYTES + 64) / 1e6

ns.cppyy.cppdef("""
    using namespace ns3;
    static void Say(Ptr<Socket> socket, uint32_t bytes) { socket->Send(Create<Packet>(bytes)); }
    void SayAt(Ptr<Socket> socket, uint32_t bytes, double time) { Simulator::Schedule(Seconds(time), &Say, socket, bytes); }
""")


def delivered(stations: int, load: float, place: str, seed: int) -> tuple[int, float]:
    """How many frames are said and which share of their receivers gets them."""
    ns.RngSeedManager.SetSeed(seed)
    ns.RngSeedManager.ResetNextStreamIndex()
    dice = random.Random(seed)
    nodes = ns.NodeContainer()
    nodes.Create(stations)

    channel = ns.YansWifiChannelHelper()
    channel.SetPropagationDelay("ns3::ConstantSpeedPropagationDelayModel")
    if place == "equal":
        channel.AddPropagationLoss("ns3::FixedRssLossModel", "Rss", ns.DoubleValue(-50.0))
    else:
        channel.AddPropagationLoss("ns3::LogDistancePropagationLossModel")
    phy = ns.YansWifiPhyHelper()
    phy.SetChannel(channel.Create())
    mac = ns.WifiMacHelper()
    mac.SetType("ns3::AdhocWifiMac")
    wifi = ns.WifiHelper()
    wifi.SetStandard(ns.WIFI_STANDARD_80211b)
    rate = ns.StringValue("DsssRate1Mbps")
    wifi.SetRemoteStationManager(
        "ns3::ConstantRateWifiManager", "DataMode", rate, "ControlMode", rate, "NonUnicastMode", rate
    )
    devices = wifi.Install(phy, mac, nodes)

    where = ns.CreateObject[ns.ListPositionAllocator]()
    for _ in range(stations):
        where.Add(ns.Vector(dice.uniform(0.0, 9.0), dice.uniform(0.0, 6.0), 0.5))
    mobility = ns.MobilityHelper()
    mobility.SetPositionAllocator(where)
    mobility.SetMobilityModel("ns3::ConstantPositionMobilityModel")
    mobility.Install(nodes)

    ns.PacketSocketHelper().Install(nodes)
    said, sockets = 0, []
    for index in range(stations):
        address = ns.PacketSocketAddress()
        address.SetSingleDevice(devices.Get(index).GetIfIndex())
        address.SetPhysicalAddress(ns.Mac48Address.GetBroadcast().ConvertTo())
        address.SetProtocol(1)
        socket = ns.Socket.CreateSocket(nodes.Get(index), ns.TypeId.LookupByName("ns3::PacketSocketFactory"))
        socket.Bind()
        socket.Connect(address.ConvertTo())
        sockets.append(socket)
        time = 1.0
        while (time := time + dice.expovariate(load / FRAME / stations)) < 1.0 + SECONDS:
            ns.cppyy.gbl.SayAt(socket, BYTES + IP_AND_UDP, time)
            said += 1
    sinks = ns.ApplicationContainer()
    for index in range(stations):
        heard = ns.PacketSocketAddress()
        heard.SetSingleDevice(devices.Get(index).GetIfIndex())
        heard.SetProtocol(1)
        sinks.Add(ns.PacketSinkHelper("ns3::PacketSocketFactory", heard.ConvertTo()).Install(nodes.Get(index)))

    # What still waits a second after the last word counts as lost.
    ns.Simulator.Stop(ns.Seconds(2.0 + SECONDS))
    ns.Simulator.Run()
    got = sum(sinks.Get(index).GetTotalRx() for index in range(stations)) / (BYTES + IP_AND_UDP)
    ns.Simulator.Destroy()
    return said, got / (said * (stations - 1))


def main() -> None:
    ns.Config.SetDefault("ns3::WifiMacQueue::MaxSize", ns.StringValue("50p"))
    ns.Config.SetDefault("ns3::WifiMacQueue::MaxDelay", ns.StringValue("60s"))
    print("stations,load,said,equal,pitch")
    for stations in STATIONS:
        for load in LOADS:
            said, equal = delivered(stations, load, "equal", seed=stations)
            _, pitch = delivered(stations, load, "pitch", seed=stations)
            print(f"{stations},{load},{said},{equal:.4f},{pitch:.4f}", flush=True)


if __name__ == "__main__":
    main()
