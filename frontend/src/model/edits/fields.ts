import type { NodeId, Orientation, Point } from '../diagram';
import { assign, nodeOf, type Recipe } from './core';

/** Sets the instance name; a name equal to the type removes it. */
export function setName(id: NodeId, name: string): Recipe {
  return (draft) => {
    const node = nodeOf(draft, id);
    const plain = name.trim();
    assign(node, 'name', plain === node.type || plain === node.tree ? undefined : plain);
  };
}

function setEntry(field: 'ports' | 'conditions', id: NodeId, key: string, value: string | null): Recipe {
  return (draft) => {
    const node = nodeOf(draft, id);
    const entries = node[field] ?? {};
    if (value === null) {
      const { [key]: _gone, ...rest } = entries;
      if (Object.keys(rest).length > 0) node[field] = rest;
      else delete node[field];
    } else {
      entries[key] = value;
      node[field] = entries;
    }
  };
}

/** Sets the text of a port; null restores the default. */
export const setPort = (id: NodeId, name: string, value: string | null): Recipe =>
  setEntry('ports', id, name, value);

/** Sets a condition or script such as `_skipIf`; null removes it. */
export const setCondition = (id: NodeId, name: string, value: string | null): Recipe =>
  setEntry('conditions', id, name, value);

/** Adds a port of an open action to every node of that type, with the blackboard entry of the same name. */
export function addPort(type: string, name: string): Recipe {
  return (draft) => {
    for (const node of Object.values(draft.nodes)) {
      if (node.type === type) node.ports = { [name]: `{${name}}`, ...node.ports };
    }
  };
}

/** Removes a port of an open action from every node of that type. */
export function removePort(type: string, name: string): Recipe {
  return (draft) => {
    for (const [id, node] of Object.entries(draft.nodes)) {
      if (node.type === type && node.ports?.[name] !== undefined) setPort(id, name, null)(draft);
    }
  };
}

/** Renames a port of an open action, or a remapping of a subtree, on every node of that type. */
export function renamePort(type: string, from: string, to: string): Recipe {
  return (draft) => {
    for (const node of Object.values(draft.nodes)) {
      if (node.type !== type || node.ports?.[from] === undefined) continue;
      node.ports = Object.fromEntries(
        Object.entries(node.ports).map(([name, text]) => [name === from ? to : name, text]),
      );
    }
  };
}

/** Renames a type (an action) or a tree wherever it is used. */
export function renameUse(kind: 'action' | 'tree', from: string, to: string): Recipe {
  return (draft) => {
    for (const node of Object.values(draft.nodes)) {
      if (kind === 'action' && node.type === from) node.type = to;
      if (kind === 'tree' && node.type === 'SubTree' && node.tree === from) node.tree = to;
    }
  };
}

export function setComment(id: NodeId, comment: string): Recipe {
  return (draft) => {
    assign(nodeOf(draft, id), 'comment', comment.trim() === '' ? undefined : comment);
  };
}

/** Silences a finding at a node, with the reason; null reports it again. */
export function setSilenced(id: NodeId, code: string, reason: string | null): Recipe {
  return (draft) => {
    const node = nodeOf(draft, id);
    const { [code]: _gone, ...rest } = node.silenced ?? {};
    const silenced = reason === null ? rest : { ...rest, [code]: reason };
    assign(node, 'silenced', Object.keys(silenced).length > 0 ? silenced : undefined);
  };
}

export function setColor(id: NodeId, color: string | null): Recipe {
  return (draft) => {
    assign(nodeOf(draft, id), 'color', color ?? undefined);
  };
}

export function setDisabled(ids: readonly NodeId[], disabled: boolean): Recipe {
  return (draft) => {
    for (const id of ids) assign(nodeOf(draft, id), 'disabled', disabled);
  };
}

export function setCollapsed(id: NodeId, collapsed: boolean): Recipe {
  return (draft) => {
    assign(nodeOf(draft, id), 'collapsed', collapsed);
  };
}

/** Sets the manual position of a block. */
export function setPosition(id: NodeId, position: Point): Recipe {
  return (draft) => {
    nodeOf(draft, id).position = [Math.round(position[0]), Math.round(position[1])];
  };
}

/** Removes all manual positions, so that the layout is automatic. */
export function tidy(): Recipe {
  return (draft) => {
    for (const node of Object.values(draft.nodes)) delete node.position;
  };
}

export function setLayout(layout: Orientation): Recipe {
  return (draft) => {
    draft.layout = layout;
    tidy()(draft);
  };
}
