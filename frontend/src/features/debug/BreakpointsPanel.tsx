import { ActionIcon, Button, Checkbox, ScrollArea, Switch } from '@mantine/core';
import { IconChevronDown, IconChevronRight, IconTrash } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { LineList } from '@/features/python/LineList';
import { StopView } from '@/features/python/StopView';
import { existing, type BlockBreakpoint } from '@/model/breakpoints';
import { displayName } from '@/model/diagram';
import {
  changeBreakpoint,
  removeAllBreakpoints,
  switchBreakpoints,
  toggleBreakpoint,
  useBreakpoints,
} from '@/store/debug/breakpoints';
import { useProjectStore } from '@/store/project';
import { openTree } from '@/store/project/navigation';
import { useSessionStore } from '@/store/session/store';
import { BreakpointFields } from './BreakpointFields';
import { ForcedList } from './ForcedList';
import { useMomentWords } from './words';
import classes from './debug.module.css';

/** All breakpoints of the project, and all that is forced in its run. */
export function BreakpointsPanel() {
  const { t } = useTranslation('debug');
  const list = useBreakpoints((state) => state.list);
  const areOn = useBreakpoints((state) => state.areOn);
  const refusal = useBreakpoints((state) => state.refusal);
  const diagrams = useProjectStore((state) => state.diagrams);
  const isViewer = useSessionStore(({ introspection }) => introspection?.role === 'viewer');
  const shown = existing(list, diagrams);
  return (
    <ScrollArea h="100%" type="auto" data-testid="breakpoints">
      <div className={classes['panel']}>
        <StopView />
        {shown.length === 0 ? (
          <p className={classes['note']}>{t('none')}</p>
        ) : (
          <div className={classes['buttons']}>
            <Switch
              size="md"
              label={t('areOn')}
              checked={areOn}
              data-testid="breakpoints-on"
              onChange={switchBreakpoints}
            />
            <Button size="compact-xs" variant="default" onClick={removeAllBreakpoints}>
              {t('removeAll')}
            </Button>
          </div>
        )}
        {isViewer && <p className={classes['note']}>{t('ofViewer')}</p>}
        {refusal && (
          <p className={classes['refusal']} role="alert" data-testid="breakpoint-refusal">
            {refusal}
          </p>
        )}
        <ul className={classes['list']} aria-label={t('list')}>
          {shown.map((each) => (
            <Row key={`${each.tree_id}/${each.node_id}`} breakpoint={each} />
          ))}
        </ul>
        <ForcedList />
        <LineList />
      </div>
    </ScrollArea>
  );
}

function Row({ breakpoint: each }: { readonly breakpoint: BlockBreakpoint }) {
  const { t } = useTranslation('debug');
  const node = useProjectStore((state) => state.diagrams[each.tree_id]?.nodes[each.node_id]);
  const words = useMomentWords();
  const [isOpen, setOpen] = useState(false);
  if (!node) return null;
  const name = displayName(node);
  const reveal = () => {
    openTree(each.tree_id);
    useProjectStore.getState().reveal(each.tree_id, each.node_id);
  };
  return (
    <li className={classes['row']} data-testid={`row-${each.node_id}`}>
      <div className={classes['line']}>
        <Checkbox
          size="md"
          aria-label={t('isOn', { name })}
          checked={each.on}
          onChange={({ currentTarget: { checked } }) =>
            changeBreakpoint(each.tree_id, each.node_id, { on: checked })
          }
        />
        <button type="button" className={classes['place']} title={t('show')} onClick={reveal}>
          {name}
        </button>
        <span className={classes['moment']} title={`${each.tree_id} · ${words(each)}`}>
          {words(each)}
        </span>
        <ActionIcon
          size={24}
          aria-label={t('edit', { name })}
          aria-expanded={isOpen}
          data-testid={`edit-${each.node_id}`}
          onClick={() => setOpen(!isOpen)}
        >
          {isOpen ? <IconChevronDown size={15} /> : <IconChevronRight size={15} />}
        </ActionIcon>
        <ActionIcon
          size={24}
          aria-label={t('removeOf', { name })}
          data-testid={`remove-${each.node_id}`}
          onClick={() => toggleBreakpoint(each.tree_id, each.node_id)}
        >
          <IconTrash size={15} />
        </ActionIcon>
      </div>
      {isOpen && (
        <div className={classes['edit']}>
          <BreakpointFields breakpoint={each} />
        </div>
      )}
    </li>
  );
}
