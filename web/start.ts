/** Starts what the address asks for: the app, or with `?study` the blind test. */
const wanted = new URLSearchParams(location.search).has('study') ? import('./study') : import('./main');
wanted.then(
  () => document.querySelector('.unstarted')?.remove(),
  (error: unknown) => {
    console.error(error);
    document.body.textContent =
      origin === 'null'
        ? 'The frame that shows this page is sandboxed, so the page cannot run in it. Open it in a tab of its own.'
        : 'A part of this page could not be loaded. Check the connection, then reload the page.';
  },
);
