import { NativeSelect, NumberInput, TextInput } from '@mantine/core';
import { useState } from 'react';
import type { BreakpointMoment, ResultName, TreeNode } from '@/generated/messages';
import { MOMENTS, RESULTS, type BlockBreakpoint } from '@/model/breakpoints';
import { changeBreakpoint } from '@/store/debug/breakpoints';
import { instanceOf, isOwnTree, nodesOf } from '@/store/debug/debugger';
import { useSessionStore } from '@/store/session/store';
import { usePlainWords } from '@/ui/hooks/usePlainWords';
import classes from './debug.module.css';

/** The moments at which another program can be held. */
const OF_OTHERS: readonly BreakpointMoment[] = ['before', 'after'];

/** The fields of a breakpoint: when it holds the tree, and under which conditions. */
export function BreakpointFields({ breakpoint: each }: { readonly breakpoint: BlockBreakpoint }) {
  const t = usePlainWords('debug');
  const tree = useSessionStore((state) => state.tree);
  const isOwn = useSessionStore(isOwnTree);
  const nodes = nodesOf({ tree }, each.tree_id, each.node_id);
  const change = (next: Partial<BlockBreakpoint>) => changeBreakpoint(each.tree_id, each.node_id, next);
  return (
    <div className={classes['fields']}>
      <NativeSelect
        size="xs"
        label={t('field.when')}
        value={each.when}
        data={(isOwn ? MOMENTS : OF_OTHERS).map((value) => ({ value, label: t(`when.${value}`) }))}
        data-testid="breakpoint-when"
        onChange={({ currentTarget: { value } }) => change({ when: value as BreakpointMoment })}
      />
      {each.when === 'returns' && (
        <NativeSelect
          size="xs"
          label={t('field.status')}
          value={each.status ?? 'FAILURE'}
          data={[...RESULTS]}
          data-testid="breakpoint-status"
          onChange={({ currentTarget: { value } }) => change({ status: value as ResultName })}
        />
      )}
      {isOwn && (
        <NumberInput
          size="xs"
          label={t('field.hits')}
          value={each.hits}
          min={1}
          max={1_000_000}
          allowDecimal={false}
          clampBehavior="strict"
          onChange={(value) => typeof value === 'number' && value >= 1 && change({ hits: value })}
        />
      )}
      {nodes.length > 1 && (
        <Instance
          nodes={nodes}
          tree={tree}
          instance={each.instance}
          onChange={(instance) => change({ instance })}
        />
      )}
      {isOwn && (
        <>
          <Line
            label={t('field.condition')}
            placeholder={t('field.conditionExample')}
            testId="breakpoint-condition"
            value={each.condition}
            onDone={(condition) => change({ condition })}
          />
          <Line
            label={t('field.log')}
            placeholder={t('field.logExample')}
            testId="breakpoint-log"
            value={each.log}
            onDone={(log) => change({ log })}
          />
        </>
      )}
    </div>
  );
}

interface InstanceProps {
  readonly nodes: readonly TreeNode[];
  readonly tree: readonly TreeNode[];
  readonly instance: BlockBreakpoint['instance'];
  readonly onChange: (instance: string[] | null) => void;
}

/** The choice between all instances of a shared tree and one. */
function Instance({ nodes, tree, instance, onChange }: InstanceProps) {
  const t = usePlainWords('debug');
  const choices = nodes.map((node) => ({ value: JSON.stringify(instanceOf(tree, node)), label: node.path }));
  return (
    <NativeSelect
      size="xs"
      label={t('field.instance')}
      value={JSON.stringify(instance)}
      data={[{ value: 'null', label: t('field.allInstances', { count: nodes.length }) }, ...choices]}
      onChange={({ currentTarget: { value } }) => onChange(JSON.parse(value) as string[] | null)}
    />
  );
}

interface LineProps {
  readonly label: string;
  readonly placeholder: string;
  readonly testId: string;
  readonly value: string;
  readonly onDone: (value: string) => void;
}

/** A text that counts when the field is left, or with Enter: a condition that is half typed is no condition. */
function Line({ label, placeholder, testId, value, onDone }: LineProps) {
  const [typed, setTyped] = useState<string | null>(null);
  const done = () => {
    if (typed !== null && typed.trim() !== value) onDone(typed.trim());
    setTyped(null);
  };
  return (
    <TextInput
      size="xs"
      className={classes['wide'] ?? ''}
      label={label}
      placeholder={placeholder}
      maxLength={1000}
      spellCheck={false}
      data-testid={testId}
      value={typed ?? value}
      onChange={({ currentTarget }) => setTyped(currentTarget.value)}
      onBlur={done}
      onKeyDown={({ key }) => {
        if (key === 'Enter') done();
      }}
    />
  );
}
