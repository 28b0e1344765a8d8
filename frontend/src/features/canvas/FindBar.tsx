import { ActionIcon } from '@mantine/core';
import { IconChevronDown, IconChevronUp, IconX } from '@tabler/icons-react';
import { useEffect, useMemo, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { NodeId } from '@/model/diagram';
import { findNodes } from '@/model/find';
import { setEditor } from '@/store/project/editor';
import { letGoOfDocument } from '@/workspace/focus';
import { useProjectStore } from '@/store/project';
import classes from './Canvas.module.css';

interface FindBarProps {
  readonly treeId: string;
  readonly onClose: () => void;
  /** Whether what is found is marked in the whole of the tree; then Enter goes to it, and typing does not. */
  readonly isWhole?: boolean;
  /** Called with the blocks that are found. */
  readonly onFound?: (ids: readonly NodeId[]) => void;
}

/** The search bar for names, types, ports and comments of the tree; Enter selects the next match. */
export function FindBar({ treeId, onClose, isWhole = false, onFound }: FindBarProps) {
  const { t } = useTranslation('canvas');
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    letGoOfDocument();
    field.current?.focus();
  }, []);
  const [text, setText] = useState('');
  const [index, setIndex] = useState(0);
  const diagram = useProjectStore((state) => state.diagrams[treeId]);
  const reveal = useProjectStore((state) => state.reveal);
  const found = useMemo(() => (diagram ? findNodes(diagram, text) : []), [diagram, text]);
  useEffect(() => onFound?.(found), [found, onFound]);

  const go = (to: number): void => {
    const at = (to + found.length) % Math.max(1, found.length);
    setIndex(at);
    const id = found[at];
    if (id !== undefined) reveal(treeId, id);
  };
  const close = (): void => {
    setEditor({ find: false });
    onClose();
  };

  return (
    <div className={classes['find']} role="search" data-overlay>
      <input
        ref={field}
        aria-label={t('find.label')}
        placeholder={t('find.label')}
        value={text}
        onChange={(event) => {
          const next = event.currentTarget.value;
          setText(next);
          setIndex(0);
          const [first] = diagram ? findNodes(diagram, next) : [];
          if (first !== undefined && !isWhole) reveal(treeId, first);
        }}
        onKeyDown={(event) => {
          event.stopPropagation();
          if (event.key === 'Enter') go(isWhole ? index : index + (event.shiftKey ? -1 : 1));
          if (event.key === 'Escape') close();
        }}
      />
      <span className={classes['findCount']} aria-live="polite">
        {text && t('find.count', { index: found.length === 0 ? 0 : index + 1, count: found.length })}
      </span>
      <ActionIcon
        aria-label={t('find.previous')}
        onClick={() => {
          go(index - 1);
        }}
      >
        <IconChevronUp size={16} aria-hidden="true" />
      </ActionIcon>
      <ActionIcon
        aria-label={t('find.next')}
        onClick={() => {
          go(index + 1);
        }}
      >
        <IconChevronDown size={16} aria-hidden="true" />
      </ActionIcon>
      <ActionIcon aria-label={t('find.close')} onClick={close}>
        <IconX size={16} aria-hidden="true" />
      </ActionIcon>
    </div>
  );
}
