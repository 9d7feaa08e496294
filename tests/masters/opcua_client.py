"""An OPC UA client, by asyncua: PORT. No master is there, and no program writes."""

import asyncio
import sys

from asyncua import Client, ua

INPUT, OUTPUT = "N1_UINTs_01_M_to_C", "N1_UINTs_01_C_to_M"
ELEMENTS = 15
PATIENCE_S = 20


async def main(port):
    async with Client(f"opc.tcp://127.0.0.1:{port}") as client:
        namespace = await client.get_namespace_index("urn:ectwin")
        nodes = Nodes(client, namespace)
        await browses(client, namespace)
        await reads_with_quality(nodes)
        await writes_and_reads_back(nodes)
        await refused(nodes)
        await watches(client, nodes)


class Nodes:
    def __init__(self, client, namespace):
        self.client, self.namespace = client, namespace

    def __getitem__(self, name):
        return self.client.get_node(ua.NodeId(name, self.namespace))


async def browses(client, namespace):
    folder = await client.nodes.objects.get_child(f"{namespace}:N1")
    names = [(await node.read_browse_name()).Name for node in await folder.get_children()]
    expect(INPUT in names and OUTPUT in names, f"nodes of the folder: {names}")


async def reads_with_quality(nodes):
    value = await nodes[INPUT].read_data_value(raise_on_bad_status=False)
    expect(value.Value.Value == [0] * ELEMENTS, f"input: {value}")
    expect(value.Value.VariantType == ua.VariantType.UInt16, f"type of the input: {value}")
    # Without a master there are no valid data.
    expect(not value.StatusCode.is_good(), f"quality of the input: {value}")
    expect(await nodes[INPUT].read_array_dimensions() == [ELEMENTS], "dimensions of the input")


async def writes_and_reads_back(nodes):
    values = list(range(100, 100 + ELEMENTS))
    await nodes[OUTPUT].write_value(uints(values))
    expect(await read(nodes[OUTPUT]) == values, "what was written is read back")
    await write_range(nodes[OUTPUT], "3:4", uints([7, 8]))
    values[3:5] = [7, 8]
    expect(await read(nodes[OUTPUT]) == values, "the elements that were written are read back")


async def refused(nodes):
    output = nodes[OUTPUT]
    before = await read(output)
    await refuses("BadNotWritable", nodes[INPUT].write_value(uints([0] * ELEMENTS)))
    await refuses("BadTypeMismatch", output.write_value(ua.Variant([1.5] * ELEMENTS, ua.VariantType.Double)))
    await refuses("BadTypeMismatch", output.write_value(ua.Variant(1, ua.VariantType.UInt16)))
    await refuses("BadOutOfRange", output.write_value(uints([0] * (ELEMENTS + 1))))
    await refuses("BadIndexRangeNoData", write_range(output, "14:15", uints([0, 0])))
    await refuses("BadIndexRangeDataMismatch", write_range(output, "0:1", uints([0])))
    await refuses("BadNodeIdUnknown", nodes["N1_nothing"].read_value())
    expect(await read(output) == before, "nothing of what is refused is written")


async def watches(client, nodes):
    changed = asyncio.Event()

    class Watcher:
        def datachange_notification(self, node, value, data):
            if value[0] == 0x4242:
                changed.set()

    subscription = await client.create_subscription(50, Watcher())
    await subscription.subscribe_data_change(nodes[OUTPUT])
    await write_range(nodes[OUTPUT], "0", uints([0x4242]))
    await asyncio.wait_for(changed.wait(), PATIENCE_S)


def uints(values):
    return ua.Variant(values, ua.VariantType.UInt16)


async def read(node):
    return (await node.read_data_value(raise_on_bad_status=False)).Value.Value


async def write_range(node, index_range, variant):
    write = ua.WriteValue()
    write.NodeId, write.AttributeId = node.nodeid, ua.AttributeIds.Value
    write.IndexRange, write.Value = index_range, ua.DataValue(variant)
    parameters = ua.WriteParameters()
    parameters.NodesToWrite = [write]
    for result in await node.session.write(parameters):
        result.check()


async def refuses(status, request):
    try:
        await request
    except ua.UaStatusCodeError as error:
        name = ua.StatusCode(error.code).name
        expect(name == status, f"{status} expected, {name} came")
        return
    expect(False, f"{status} expected, and it was done")


def expect(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


if __name__ == "__main__":
    asyncio.run(main(sys.argv[1]))
