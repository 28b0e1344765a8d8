import type { DiagramNode, NodeId } from '../diagram';
import { pointerOf } from '../ports';
import { isProblem, readScript } from '../script';
import type { NodeSpec } from '../vocabulary';
import { atPort, type Problem } from './problem';

/** Checks scripts, like `translator/check/script.py`. */

function checkScript(id: NodeId, port: string, code: string): Problem[] {
  const facts = readScript(code);
  return isProblem(facts) ? [{ ...atPort('broken-script', id, port), script: facts }] : [];
}

/** Checks the script over the fields of a message that a subscription waits for. */
function checkFieldCondition(id: NodeId, node: DiagramNode): Problem[] {
  const code = node.type === 'RosSubscribe' ? (node.ports?.['condition'] ?? '') : '';
  return code.trim() === '' || pointerOf(code) !== null ? [] : checkScript(id, 'condition', code);
}

/** Checks the conditions of any node, and the ports that hold code; a `Script` may be empty. */
export function checkScripts(id: NodeId, node: DiagramNode, spec: NodeSpec | undefined): Problem[] {
  const conditions = Object.entries(node.conditions ?? {}).flatMap(([name, code]) =>
    code.trim() === '' ? [atPort('empty-script', id, name)] : checkScript(id, name, code),
  );
  const ports = (spec?.ports ?? []).flatMap(({ name, type }) => {
    const code = type === 'script' ? node.ports?.[name] : undefined;
    if (code === undefined || pointerOf(code) !== null) return [];
    if (code.trim() !== '') return checkScript(id, name, code);
    return code === '' && node.type === 'Script' ? [] : [atPort('empty-script', id, name)];
  });
  return [...conditions, ...ports, ...checkFieldCondition(id, node)];
}
