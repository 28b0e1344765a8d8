import { ActionIcon, Tooltip } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeId } from '@/model/diagram';
import { setPort } from '@/model/edits';
import type { PortSpec } from '@/model/ports';
import { fieldLabel, fieldPort, firstValue, typePortOf } from '@/model/rosFields';
import { blackboardKeys } from '@/model/vocabulary';
import { keyOf } from '@/model/keys/rename';
import { openRenameKey } from '@/store/dialogs/renameKey';
import { change } from '@/store/project/edits/blocks';
import { portsInUse, shared } from '@/store/project/edits/ports';
import { liveKey } from '@/store/project/live';
import { problemsOf } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { shownPort } from '@/store/session/values/shown';
import { useProblemText } from '@/ui/hooks/useProblemText';
import { shippedPort } from '@/i18n/shipped';
import { keepPort } from '@/store/run/livePorts';
import { usePortMarks } from '@/store/run/portMarks';
import { FieldPicker } from './ports/FieldPicker';
import { OutdatedPorts } from './ports/OutdatedPorts';
import { useInterfaceFields, useInterfaceNames } from './ports/useInterfaces';
import { PortField } from './PortField';
import { PortNameInput } from './PortNameInput';
import { Section } from './Section';
import type { Target } from './target';
import classes from './Inspector.module.css';

const extraPort = (name: string): PortSpec => ({
  name,
  direction: 'inout',
  type: 'any',
  default: null,
  required: false,
  description: '',
});

/**
 * Returns whether all blocks of the type share their ports: the action declares none, or does not exist yet.
 */
const isShared = ({ node, spec }: Pick<Target, 'node' | 'spec'>): boolean =>
  node.type !== 'SubTree' && (spec === undefined || (spec.source === 'action' && spec.open));

/** The ports of the block, declared ones first; an open type accepts additional ones. */
export function PortList(target: Target) {
  const { diagram, id, node, spec } = target;
  const { t } = useTranslation('inspector');
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const marks = usePortMarks(diagram.id, id, node.ports);
  const textOf = useProblemText();
  const [isAdding, setIsAdding] = useState(false);
  const [fresh, setFresh] = useState<{ readonly id: NodeId; readonly name: string } | null>(null);
  const keys = useMemo(() => [...blackboardKeys(diagram, vocabulary).keys()].sort(), [diagram, vocabulary]);
  const declared = spec?.ports ?? [];
  const typePort = typePortOf(node.type);
  const types = useInterfaceNames(node.type);
  const fields = useInterfaceFields(node);
  const portOf = (name: string): PortSpec => {
    const field = fields?.find((each) => each.port === name);
    return field ? fieldPort(node.type, field) : extraPort(name);
  };
  const known = new Set(declared.map((port) => port.name));
  const areShared = isShared(target);
  const inUse = areShared ? portsInUse(node.type) : Object.keys(node.ports ?? {});
  const extra = inUse.filter((name) => !known.has(name));
  const taken = [...known, ...extra];
  const set = (name: string, value: string | null) => {
    change('port', [setPort(id, name, value)], { mergeKey: `port ${id} ${name}` });
  };
  const remove = (name: string) => {
    if (areShared) shared.remove(node.type, name);
    else set(name, null);
  };
  const problems = problemsOf(diagram, vocabulary, diagnostics).filter((each) => each.node === id);
  const errorOf = (name: string): string | null => {
    const problem = problems.find((each) => each.port === name);
    return problem ? textOf(problem).message : null;
  };
  const isOpen = spec?.open ?? true;
  return (
    <Section
      title={t('ports')}
      {...(isOpen
        ? {
            action: (
              <Tooltip label={t('addPort')}>
                <ActionIcon
                  size={24}
                  aria-label={t('addPort')}
                  onClick={() => {
                    setIsAdding(true);
                  }}
                >
                  <IconPlus size={15} aria-hidden="true" />
                </ActionIcon>
              </Tooltip>
            ),
          }
        : {})}
    >
      {spec?.outdated && <OutdatedPorts action={node.type} />}
      {declared.length + extra.length === 0 && !isAdding && <p className={classes['none']}>{t('noPorts')}</p>}
      {[...declared, ...extra.map(portOf)].map((port) => (
        <PortField
          key={`${id} ${port.name}`}
          port={{ ...port, description: shippedPort(node.type, port.name, port.description) }}
          value={node.ports?.[port.name] ?? null}
          keys={keys}
          shown={shownPort(diagram.id, id, port.name)}
          isNew={fresh?.id === id && fresh.name === port.name}
          onLeave={() => {
            setFresh(null);
          }}
          error={errorOf(port.name)}
          taken={taken}
          {...(types && port.name === typePort?.port ? { types } : {})}
          {...(typePort && port.name.includes('__') ? { label: fieldLabel(port.name) } : {})}
          mark={marks.get(port.name)}
          onKeep={() => keepPort(liveKey(diagram.id, id), port.name, node.ports?.[port.name] ?? null)}
          onBack={(saved) => {
            useProjectStore.getState().seal();
            set(port.name, saved);
          }}
          onChange={(value) => {
            set(port.name, value);
          }}
          onRenameKey={(key) => openRenameKey(keyOf(diagram.id, key))}
          onRemove={known.has(port.name) ? undefined : () => remove(port.name)}
          onRename={
            known.has(port.name) || !areShared
              ? undefined
              : (name) => shared.rename(node.type, port.name, name)
          }
        />
      ))}
      {isAdding && fields && (
        <FieldPicker
          fields={fields}
          taken={taken}
          onDone={(field) => {
            if (field !== null) {
              setFresh({ id, name: field.port });
              set(field.port, firstValue(node.type, field));
            }
            setIsAdding(false);
          }}
        />
      )}
      {isAdding && !fields && (
        <PortNameInput
          taken={taken}
          onDone={(name, byKey) => {
            if (name !== null && byKey) setFresh({ id, name });
            if (name !== null && areShared) shared.add(node.type, name);
            else if (name !== null) set(name, `{${name}}`);
            setIsAdding(false);
          }}
        />
      )}
    </Section>
  );
}
