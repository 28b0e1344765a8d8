import { Button, Radio, ScrollArea, Stack, Text } from '@mantine/core';
import { useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Candidate, PartKind } from '@/api/imports';
import classes from './importing.module.css';

interface Props {
  readonly items: readonly Candidate[];
  readonly kind: PartKind | null;
  readonly chosen: Candidate;
  readonly onChoose: (item: Candidate) => void;
}

/** Returns the items that are likely what the user wants; all, if that says nothing. */
export function likelyOf(items: readonly Candidate[], kind: PartKind | null): readonly Candidate[] {
  const wanted = items.filter((item) => kind === null || item.kind === kind);
  const mains = wanted.filter((item) => item.is_main);
  return mains.length > 0 ? mains : wanted.length > 0 ? wanted : items;
}

/** Returns the text by which a radio button knows a file; one file may be offered as two kinds. */
const valueOf = ({ kind, path }: Candidate) => `${kind} ${path}`;

/** Asks which file of the upload is the robot or the world, if there are several. */
export function Choice({ items, kind, chosen, onChoose }: Props) {
  const { t } = useTranslation('importing');
  const likely = likelyOf(items, kind);
  const [isWhole, setWhole] = useState(!likely.includes(chosen));
  const group = useRef<HTMLDivElement>(null);
  const showAll = () => {
    setWhole(true);
    // The button, which has the focus, goes.
    group.current?.querySelector<HTMLInputElement>('input:checked')?.focus();
  };
  const shown = isWhole ? items : likely;
  if (items.length === 1) {
    return (
      <Text size="sm">
        {t('found')} <Label item={chosen} />
      </Text>
    );
  }
  return (
    <div ref={group}>
      <Radio.Group
        label={t(shown.length === 1 ? 'found' : 'which')}
        value={valueOf(chosen)}
        onChange={(value) => {
          const item = items.find((each) => valueOf(each) === value);
          if (item) onChoose(item);
        }}
      >
        <ScrollArea.Autosize mah="26vh" mt="xs">
          <Stack gap={6} p={2}>
            {shown.map((item) => (
              <Radio key={valueOf(item)} value={valueOf(item)} label={<Label item={item} />} />
            ))}
          </Stack>
        </ScrollArea.Autosize>
      </Radio.Group>
      {isWhole || shown.length === items.length ? null : (
        <Button mt={4} size="compact-xs" variant="subtle" onClick={showAll}>
          {t('more', { count: items.length - shown.length })}
        </Button>
      )}
    </div>
  );
}

function Label({ item: { kind, source, path } }: { readonly item: Candidate }) {
  const { t } = useTranslation('importing');
  return (
    <>
      <span className={classes['path']}>{path}</span>{' '}
      <Text span size="xs" c="dimmed">
        {t(`source.${kind === 'universe' && source === 'sdf' ? 'world' : source}`)}
      </Text>
    </>
  );
}
