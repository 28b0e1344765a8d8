import { IconActivity } from '@tabler/icons-react';
import type { UserCommand } from '@/commands/registry';
import { keyIn } from '@/model/keys/entry';
import { portLines } from '@/model/measure';
import { specOf } from '@/model/vocabulary';
import { useProjectStore } from '@/store/project';
import { activeDiagram } from '@/store/project/edits/blocks';
import { shownPort, showValues, useShownValues, type ShownPort } from '@/store/session/values/shown';

/** Returns the ports of the selected blocks that refer to an entry of the blackboard. */
function portsOfSelection(): ShownPort[] {
  const diagram = activeDiagram();
  const { selection, vocabulary } = useProjectStore.getState();
  return selection.flatMap((id) => {
    const node = diagram?.nodes[id];
    if (!diagram || !node) return [];
    return portLines(node, specOf(vocabulary, node))
      .filter((line) => keyIn(line.value ?? line.default ?? '', line.name) !== null)
      .map(({ name }) => shownPort(diagram.id, id, name));
  });
}

export const valuesCommand: UserCommand = {
  id: 'canvas.values',
  group: 'canvas',
  labelKey: 'canvas:command.values',
  icon: IconActivity,
  enabled: () => portsOfSelection().length > 0,
  run: () => {
    const ports = portsOfSelection();
    const { ports: shown } = useShownValues.getState();
    showValues(ports, !ports.every((port) => shown.has(port)));
  },
};
