import { ActionIcon, Tooltip } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { setPort } from '@/model/edits';
import type { PortSpec } from '@/model/ports';
import { blackboardKeys } from '@/model/vocabulary';
import { change } from '@/store/project/commands';
import { problemsOf } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { useProblemText } from '@/ui/useProblemText';
import { AddPort } from './AddPort';
import { PortField } from './PortField';
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

/** Ports of the block, declared ones first; an open type takes any other. */
export function PortList({ diagram, id, node, spec }: Target) {
  const { t } = useTranslation('inspector');
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const textOf = useProblemText();
  const [isAdding, setIsAdding] = useState(false);
  const keys = useMemo(() => [...blackboardKeys(diagram, vocabulary).keys()].sort(), [diagram, vocabulary]);
  const declared = spec?.ports ?? [];
  const known = new Set(declared.map((port) => port.name));
  const extra = Object.keys(node.ports ?? {}).filter((name) => !known.has(name));
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
                  size={22}
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
      {declared.length + extra.length === 0 && !isAdding && <p className={classes['none']}>{t('noPorts')}</p>}
      {[...declared, ...extra.map(extraPort)].map((port) => (
        <PortField
          key={`${id} ${port.name}`}
          port={port}
          value={node.ports?.[port.name] ?? null}
          keys={keys}
          error={errorOf(port.name)}
          isExtra={!known.has(port.name)}
          onChange={(value) => {
            change('port', [setPort(id, port.name, value)], { mergeKey: `port ${id} ${port.name}` });
          }}
        />
      ))}
      {isAdding && (
        <AddPort
          taken={[...known, ...extra]}
          onDone={(name) => {
            if (name !== null) change('port', [setPort(id, name, `{${name}}`)]);
            setIsAdding(false);
          }}
        />
      )}
    </Section>
  );
}
