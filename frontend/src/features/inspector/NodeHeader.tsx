import { Button, TextInput } from '@mantine/core';
import { IconArrowsExchange, IconBinaryTree, IconCode } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { setName } from '@/model/edits';
import { change } from '@/store/project/edits/blocks';
import { setEditor } from '@/store/project/editor';
import { openAction, openTree } from '@/store/project/navigation';
import { FamilyTile } from '@/ui/FamilyTile';
import type { Target } from './target';
import classes from './Inspector.module.css';

/** The header: name, type, and a button that opens the block's document. */
export function NodeHeader({ tree, id, node, spec }: Target) {
  const { t } = useTranslation('inspector');
  // The document drops outer blanks and a name that equals the type; the field keeps both while the user
  // types.
  const [typed, setTyped] = useState('');
  const plain = typed.trim();
  const named = plain === node.type || plain === node.tree ? '' : plain;
  const name = node.name ?? '';
  return (
    <div className={classes['header']}>
      <div className={classes['identity']}>
        <FamilyTile type={node.type} family={spec?.family ?? null} size={36} />
        <TextInput
          className={classes['grow'] ?? ''}
          size="sm"
          aria-label={t('name')}
          data-testid="node-name"
          placeholder={node.tree ?? node.type}
          value={named === name ? typed : name}
          onBlur={() => {
            setTyped('');
          }}
          onChange={(event) => {
            setTyped(event.currentTarget.value);
            change('rename', [setName(id, event.currentTarget.value)], { mergeKey: `name ${id}` });
          }}
        />
      </div>
      <div className={classes['buttons']}>
        <span className={classes['typeName']}>{node.type}</span>
        <Button
          size="compact-xs"
          variant="subtle"
          color="gray"
          leftSection={<IconArrowsExchange size={14} aria-hidden="true" />}
          onClick={(event) => {
            const { left, bottom } = event.currentTarget.getBoundingClientRect();
            setEditor({
              quickAdd: { tree, goal: { does: 'morph', node: id }, x: left, y: bottom + 4, text: '' },
            });
          }}
        >
          {t('changeType')}
        </Button>
        {spec?.source === 'action' && (
          <Button
            size="compact-xs"
            variant="light"
            leftSection={<IconCode size={14} aria-hidden="true" />}
            data-testid="open-code"
            onClick={() => {
              openAction(node.type);
            }}
          >
            {t('openCode')}
          </Button>
        )}
        {node.type === 'SubTree' && node.tree !== undefined && (
          <Button
            size="compact-xs"
            variant="light"
            leftSection={<IconBinaryTree size={14} aria-hidden="true" />}
            onClick={() => {
              if (node.tree) openTree(node.tree);
            }}
          >
            {t('openTree')}
          </Button>
        )}
      </div>
    </div>
  );
}
